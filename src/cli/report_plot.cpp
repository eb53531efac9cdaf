// Scatter plots with logarithmic axes, as SVG. Colours are dark on white, and every group has a shape of its own, so
// that a plot printed in grey says the same.
#include <algorithm>
#include <cstdio>

#include "base/elementary.h"
#include "cli/report_document.h"

namespace shodo {

namespace {

constexpr double kWidth = 620, kHeight = 440;
constexpr double kLeft = 66, kRight = 16, kTop = 40, kBottom = 84;

constexpr const char* kColours[] = {"#1f4e9c", "#b3261e", "#1b7a3d", "#8a4fb0", "#b56a00", "#5b6470", "#0b7285"};
constexpr std::uint32_t kShapes = 7;

template <class... Values>
std::string printed(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

double log10_of(double x) { return logarithm(x) / logarithm(10); }

double ten_to(int exponent) {
  double value = 1;
  for (int k = 0; k < exponent; ++k) value *= 10;
  for (int k = 0; k > exponent; --k) value /= 10;
  return value;
}

int floor_of(double x) {
  const int whole = static_cast<int>(x);
  return whole > x ? whole - 1 : whole;
}

/// "5 k", "0.02": short, exact for 1, 2 and 5 times powers of ten.
std::string tick_text(double value) {
  if (value >= 1e9) return printed("%.4g G", value / 1e9);
  if (value >= 1e6) return printed("%.4g M", value / 1e6);
  if (value >= 1e3) return printed("%.4g k", value / 1e3);
  return printed("%.4g", value);
}

/// A logarithmic axis over `length` pixels.
class Axis {
 public:
  Axis(const std::vector<PlotPoint>& points, double PlotPoint::*value, double length) : length_(length) {
    for (const PlotPoint& p : points) {
      low_ = ticks_ == 0 ? p.*value : std::min(low_, p.*value);
      high_ = ticks_ == 0 ? p.*value : std::max(high_, p.*value);
      ticks_ = 1;
    }
    const double margin = 0.06 * std::max(0.3, log10_of(high_ / low_));
    start_ = log10_of(low_) - margin;
    span_ = log10_of(high_) + margin - start_;
  }

  double at(double value) const { return length_ * (log10_of(value) - start_) / span_; }

  struct Tick {
    double value;
    bool labelled;
  };
  /// At 1, 2, 5 times powers of ten, over less than a decade at every digit; over more than two decades only the powers
  /// are labelled.
  std::vector<Tick> ticks() const {
    std::vector<Tick> found;
    for (int decade = floor_of(start_); decade <= floor_of(start_ + span_); ++decade) {
      for (int step = 1; step < 10; ++step) {
        if (step != 1 && step != 2 && step != 5 && span_ > 1.1) continue;
        const double value = step * ten_to(decade), place = log10_of(value);
        if (place >= start_ && place <= start_ + span_) found.push_back({value, step == 1 || span_ < 2.2});
      }
    }
    const auto labelled = std::count_if(found.begin(), found.end(), [](const Tick& tick) { return tick.labelled; });
    if (labelled >= 2) return found;
    found = {{low_, true}};  // too near to each other for round ones
    if (high_ > low_) found.push_back({high_, true});
    return found;
  }

 private:
  double length_, low_ = 1, high_ = 10, start_ = 0, span_ = 1;
  int ticks_ = 0;
};

/// The mark of a group, about `size` pixels wide, at the origin.
std::string shape(std::uint32_t group, double size) {
  const double r = size / 2, t = 1.2 * r;
  switch (group % kShapes) {
    case 0: return printed("<circle r=\"%.1f\"/>", r);
    case 1: return printed("<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\"/>", -r, -r, size, size);
    case 2: return printed("<path d=\"M0 %.1fL%.1f 0L0 %.1fL%.1f 0Z\"/>", -t, t, t, -t);
    case 3: return printed("<path d=\"M0 %.1fL%.1f %.1fL%.1f %.1fZ\"/>", -t, t, r, -t, r);
    case 4: return printed("<path d=\"M0 %.1fL%.1f %.1fL%.1f %.1fZ\"/>", t, t, -r, -t, -r);
    case 5: return printed("<path d=\"M%.1f 0H%.1fM0 %.1fV%.1f\"/>", -t, t, -t, t);
  }
  return printed("<path d=\"M%.1f %.1fL%.1f %.1fM%.1f %.1fL%.1f %.1f\"/>", -r, -r, r, r, -r, r, r, -r);
}

std::string mark(std::uint32_t group, double x, double y, const std::string& told) {
  const char* colour = kColours[group % kShapes];
  std::string text = printed("<g transform=\"translate(%.1f %.1f)\" fill=\"%s\" fill-opacity=\".75\" stroke=\"%s\" "
                             "stroke-width=\"1.2\">", x, y, colour, colour);
  if (!told.empty()) text += "<title>" + escaped(told) + "</title>";
  return text + shape(group, 8) + "</g>\n";
}

struct Box {
  double x0, y0, x1, y1;
  bool meets(const Box& b) const { return x0 < b.x1 && b.x0 < x1 && y0 < b.y1 && b.y0 < y1; }
};

/// Numbers stand at the first free place around their point: six beside it, then on ever wider rings, where a line
/// leads to it. Where none is free, the last is taken.
class Labels {
 public:
  explicit Labels(Box frame) : frame_(frame) {}

  void keep_free(double x, double y) { taken_.push_back({x - 5, y - 5, x + 5, y + 5}); }

  struct Label {
    std::string line, text;  // elements; the line is empty beside the point
  };

  Label place(double x, double y, std::uint32_t number) {
    const std::string digits = std::to_string(number);
    const double w = 6.2 * static_cast<double>(digits.size()), h = 10;
    constexpr Offset kPlaces[] = {{0.5, -0.5}, {0.5, 0.5}, {-0.5, -0.5}, {-0.5, 0.5}, {0, -0.5}, {0, 0.5}};
    Box box{};
    bool found = false;
    const auto take = [&](double cx, double cy) {
      box = {cx - w / 2, cy - h / 2, cx + w / 2, cy + h / 2};
      found = is_free(box);
      return found;
    };
    for (const Offset& p : kPlaces) {
      if (take(x + p.x * (w + 12), y + p.y * (h + 9))) break;
    }
    Label label;
    constexpr Offset kRing[] = {{1, 0},  {0.92, -0.38},  {0.92, 0.38},  {0.71, -0.71},  {0.71, 0.71},  {0.38, -0.92},
                                {-1, 0}, {-0.92, -0.38}, {-0.92, 0.38}, {-0.71, -0.71}, {-0.71, 0.71}, {0.38, 0.92},
                                {0, -1}, {-0.38, -0.92}, {0, 1},        {-0.38, 0.92}};
    constexpr double kRadii[] = {26, 38, 50, 62, 74, 86};
    for (const double radius : kRadii) {
      for (const Offset& p : kRing) {
        if (found || !take(x + radius * p.x, y + radius * p.y)) continue;
        const double to = radius - 8;
        label.line = printed("<path d=\"M%.1f %.1fL%.1f %.1f\"/>\n", x + 4 * p.x, y + 4 * p.y, x + to * p.x,
                             y + to * p.y);
      }
    }
    taken_.push_back(box);
    label.text = printed("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"middle\">%s</text>\n", (box.x0 + box.x1) / 2,
                         box.y1 - 1.2, digits.c_str());
    return label;
  }

 private:
  struct Offset {
    double x, y;
  };

  bool is_free(const Box& box) const {
    return box.x0 > frame_.x0 && box.x1 < frame_.x1 && box.y0 > frame_.y0 && box.y1 < frame_.y1 &&
           std::none_of(taken_.begin(), taken_.end(), [&](const Box& b) { return b.meets(box); });
  }

  Box frame_;
  std::vector<Box> taken_;
};

class Drawing {
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot),
        x_(plot.points, &PlotPoint::x, kWidth - kLeft - kRight),
        y_(plot.points, &PlotPoint::y, kHeight - kTop - kBottom) {}

  std::string text() {
    out_ = printed("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %.0f %.0f\" role=\"img\" "
                   "font-family=\"Helvetica,Arial,sans-serif\" font-size=\"11\" fill=\"#222\">\n", kWidth, kHeight);
    out_ += "<title>" + escaped(plot_.title) + "</title>\n";
    out_ += printed("<rect width=\"%.0f\" height=\"%.0f\" fill=\"#fff\"/>\n", kWidth, kHeight);
    out_ += printed("<text x=\"%.0f\" y=\"20\" font-size=\"14\" font-weight=\"bold\">", kLeft) + escaped(plot_.title) +
            "</text>\n";
    draw_axes();
    if (!plot_.points.empty()) {
      draw_front();
      draw_points();
    }
    draw_legend();
    return out_ + "</svg>\n";
  }

 private:
  double px(double x) const { return kLeft + x_.at(x); }
  double py(double y) const { return kHeight - kBottom - y_.at(y); }

  void line(double x0, double y0, double x1, double y1, const char* colour) {
    out_ += printed("<path d=\"M%.1f %.1fL%.1f %.1f\" stroke=\"%s\"/>\n", x0, y0, x1, y1, colour);
  }

  void words(double x, double y, const char* anchor, const std::string& text) {
    out_ += printed("<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\">", x, y, anchor) + escaped(text) + "</text>\n";
  }

  void draw_axes() {
    const double bottom = kHeight - kBottom, right = kWidth - kRight;
    for (const Axis::Tick& tick : x_.ticks()) {
      line(px(tick.value), kTop, px(tick.value), bottom, tick.labelled ? "#d5d9de" : "#eceef1");
      if (tick.labelled) words(px(tick.value), bottom + 15, "middle", tick_text(tick.value));
    }
    for (const Axis::Tick& tick : y_.ticks()) {
      line(kLeft, py(tick.value), right, py(tick.value), tick.labelled ? "#d5d9de" : "#eceef1");
      if (tick.labelled) words(kLeft - 6, py(tick.value) + 4, "end", tick_text(tick.value));
    }
    out_ += printed("<path d=\"M%.1f %.1fV%.1fH%.1f\" fill=\"none\" stroke=\"#444\"/>\n", kLeft, kTop, bottom, right);
    words((kLeft + right) / 2, bottom + 33, "middle", plot_.x_title);
    const double middle = (kTop + bottom) / 2;
    out_ += printed("<text transform=\"translate(16 %.1f) rotate(-90)\" text-anchor=\"middle\">", middle) +
            escaped(plot_.y_title) + "</text>\n";
  }

  /// Steps through the efficient points: right of and below it nothing costs less at no greater error.
  void draw_front() {
    std::vector<PlotPoint> front;
    for (const PlotPoint& p : plot_.points) {
      if (p.efficient) front.push_back(p);
    }
    std::stable_sort(front.begin(), front.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    if (front.empty()) return;
    out_ += printed("<path d=\"M%.1f %.1f", px(front[0].x), kTop);
    for (const PlotPoint& p : front) out_ += printed("H%.1fV%.1f", px(p.x), py(p.y));
    out_ += printed("H%.1f\" fill=\"none\" stroke=\"#222\" stroke-opacity=\".45\" stroke-dasharray=\"4 3\"/>\n",
                    kWidth - kRight);
  }

  void draw_points() {
    Labels labels({kLeft, kTop, kWidth - kRight, kHeight - kBottom});
    for (const PlotPoint& p : plot_.points) {
      labels.keep_free(px(p.x), py(p.y));
      if (p.efficient)
        out_ += printed("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"8\" fill=\"none\" stroke=\"#222\"/>\n", px(p.x), py(p.y));
      out_ += mark(p.group, px(p.x), py(p.y), p.told);
    }
    std::string lines, texts;
    for (const PlotPoint& p : plot_.points) {
      if (p.number == 0) continue;
      const Labels::Label label = labels.place(px(p.x), py(p.y), p.number);
      lines += label.line;
      texts += label.text;
    }
    out_ += "<g stroke=\"#222\" stroke-opacity=\".6\" stroke-width=\".7\">\n" + lines +
            "</g>\n<g font-size=\"10\" paint-order=\"stroke\" stroke=\"#fff\" stroke-width=\"2.5\" "
            "stroke-linejoin=\"round\">\n" + texts + "</g>\n";
  }

  /// In two rows where one is too short.
  void draw_legend() {
    double x = 12, y = kHeight - 28;
    const auto place = [&](const std::string& text, auto draw_mark) {
      const double width = 26 + 5.9 * static_cast<double>(text.size());
      if (x + width > kWidth) {
        x = 12;
        y += 18;
      }
      draw_mark();
      words(x + 10, y + 4, "start", text);
      x += width;
    };
    for (std::uint32_t group = 0; group < plot_.groups.size(); ++group) {
      const auto in_group = [&](const PlotPoint& p) { return p.group == group; };
      if (std::none_of(plot_.points.begin(), plot_.points.end(), in_group)) continue;
      place(plot_.groups[group], [&] { out_ += mark(group, x, y, ""); });
    }
    if (std::none_of(plot_.points.begin(), plot_.points.end(), [](const PlotPoint& p) { return p.efficient; })) return;
    place("efficient", [&] {
      out_ += printed("<circle cx=\"%.1f\" cy=\"%.1f\" r=\"6\" fill=\"none\" stroke=\"#222\"/>\n", x, y);
    });
  }

  const Plot& plot_;
  Axis x_, y_;
  std::string out_;
};

}  // namespace

std::string svg_text(const Plot& plot) { return Drawing(plot).text(); }

std::vector<NamedText> plot_files(const Document& document) {
  std::vector<NamedText> files;
  for (const auto& block : document.blocks) {
    if (const Plot* plot = std::get_if<Plot>(&block)) files.push_back({plot->file, svg_text(*plot)});
  }
  return files;
}

}  // namespace shodo
