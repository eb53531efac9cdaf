#include "scene/ies_file.h"

#include "base/decimal.h"
#include "base/elementary.h"
#include "base/text.h"
#include "scene/slice.h"
#include "scene/values.h"
#include "scene/words.h"

namespace shodo {

namespace {

constexpr double kMostAngles = 65535;
constexpr double kMostExponent = 1e6;
/// Parts of the largest by which planes may differ along the axis without a word.
constexpr double kSamePole = 0.01;
/// Degrees; decimal angles of a row are as even as that.
constexpr double kSameStep = 1e-3;

char upper(char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c; }
bool is_blank(char c) { return c == ' ' || c == '\t'; }
bool is_digit(char c) { return c >= '0' && c <= '9'; }

/// Takes `word` off the start of a text, whatever the case of its letters, blanks in between.
bool take_word(std::string_view& text, std::string_view word) {
  std::string_view rest = text;
  for (const char c : word) {
    while (!rest.empty() && is_blank(rest[0])) rest = slice(rest, 1);
    if (rest.empty() || upper(rest[0]) != c) return false;
    rest = slice(rest, 1);
  }
  text = rest;
  return true;
}

/// Whether a file whose first line this is multiplies by the photometric factor: those of 1986, which had no line for
/// the version, and of 1991 do.
bool is_old(std::string_view line) {
  if (!take_word(line, "IESNA") && !take_word(line, "IES")) return true;
  take_word(line, ":");
  const bool named = take_word(line, "LM-63-");
  std::uint32_t year = 0, digits = 0;
  for (const char c : line) {
    if (is_blank(c)) continue;
    if (!is_digit(c) || digits == 4) {
      if (named) break;
      return true;  // a label
    }
    year = 10 * year + static_cast<std::uint32_t>(c - '0');
    ++digits;
  }
  if (digits == 2) year += year < 50 ? 2000 : 1900;
  return year < 1995;
}

/// The lines and numbers of a file, each with its place.
class IesText {
 public:
  explicit IesText(std::string_view text) : text_(text) {
    if (text.starts_with("\xef\xbb\xbf")) at_ = line_start_ = 3;
  }

  /// The rest of the line, without its end.
  Token line() {
    Token token = here();
    if (at_ == text_.size()) return token;
    std::size_t end = at_;
    while (end < text_.size() && text_[end] != '\n') ++end;
    const bool carriage = end > at_ && text_[end - 1] == '\r';
    token.kind = TokenKind::kWord;
    token.text = slice(text_, at_, end - at_ - (carriage ? 1 : 0));
    at_ = end;
    if (at_ < text_.size()) next_line();
    return token;
  }
  /// What stands between blanks, commas and line ends.
  Token word() {
    for (; at_ < text_.size() && parts(text_[at_]); ++at_) {
      if (text_[at_] == '\n') {
        next_line();
        --at_;
      }
    }
    Token token = here();
    if (at_ == text_.size()) return token;
    const std::size_t first = at_;
    while (at_ < text_.size() && !parts(text_[at_])) ++at_;
    token.kind = TokenKind::kWord;
    token.text = slice(text_, first, at_ - first);
    return token;
  }

 private:
  static bool parts(char c) { return is_blank(c) || c == ',' || c == '\r' || c == '\n'; }
  Token here() const {
    Token token;
    token.line = line_;
    token.column = static_cast<std::uint32_t>(at_ - line_start_ + 1);
    return token;
  }
  void next_line() {
    ++line_;
    line_start_ = ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0, line_start_ = 0;
  std::uint32_t line_ = 1;
};

/// One reading of a file. The first checks it and counts, the second fills what the arena gave for that.
class IesReading {
 public:
  IesReading(std::string_view path, std::string_view text, Status& status)
      : path_(path), text_(text), status_(status) {}

  bool read(Luminaire& luminaire, std::span<float> vertical = {}, std::span<float> horizontal = {},
            std::span<float> candela = {});
  std::size_t verticals() const { return verticals_; }
  std::size_t horizontals() const { return horizontals_ + (closes_ ? 1 : 0); }

 private:
  bool read_head(Luminaire& luminaire);
  bool skip_tilt(std::string_view what, Luminaire& luminaire);
  bool read_sizes();
  bool read_verticals(std::span<float> angles);
  bool read_horizontals(std::span<float> angles);
  bool read_candelas(std::span<float> candela);
  bool number(std::string_view what, const Interval& allowed, double& value, Token* at = nullptr);
  bool count(std::string_view what, std::size_t& value);
  bool next_angle(std::string_view what, double most, const float* last, float& angle, Token& at);
  MessageText mistake(const Token& at) { return mistake_at(status_, StatusCode::kScene, path_, at); }
  bool expected(const Token& at, std::string_view what);

  std::string_view path_;
  IesText text_;
  Status& status_;
  bool old_ = false;
  double scale_ = 1;
  std::size_t verticals_ = 0, horizontals_ = 0;
  bool closes_ = false;  // the half-plane at 360 isn't in the file
};

bool IesReading::expected(const Token& at, std::string_view what) {
  MessageText message = mistake(at);
  message.add("expected ").add(what);
  add_found(message, at);
  return false;
}

bool IesReading::number(std::string_view what, const Interval& allowed, double& value, Token* at) {
  const Token token = text_.word();
  if (at != nullptr) *at = token;
  if (number_of(token, allowed, value)) return true;
  MessageText message = mistake(token);
  add_expected_number(message, token, {what}, allowed);
  return false;
}

bool IesReading::count(std::string_view what, std::size_t& value) {
  double read = 0;
  Token at;
  if (!number(what, {1, kMostAngles}, read, &at)) return false;
  value = static_cast<std::size_t>(read);
  return static_cast<double>(value) == read || expected(at, "a whole number");
}

/// Down to TILT and what follows it.
bool IesReading::read_head(Luminaire& luminaire) {
  bool first = true;
  old_ = true;
  for (;; first = false) {
    const Token line = text_.line();
    if (line.kind != TokenKind::kWord) return expected(line, "a line with TILT= in an IES file");
    std::string_view rest = line.text;
    if (take_word(rest, "TILT=")) return skip_tilt(rest, luminaire);
    if (first) old_ = is_old(line.text);
  }
}

/// Factors by the lamp's tilt, if they stand here.
bool IesReading::skip_tilt(std::string_view what, Luminaire& luminaire) {
  std::string_view rest = what;
  if (take_word(rest, "NONE")) return true;
  luminaire.tilted = true;
  if (!take_word(rest = what, "INCLUDE")) return true;
  double value = 0;
  std::size_t pairs = 0;
  if (!number("lamp's geometry, 1 to 3", {1, 3}, value) || !count("pairs of angle and factor", pairs)) return false;
  for (std::size_t k = 0; k < 2 * pairs; ++k) {
    if (!number(k < pairs ? "angle of a tilt" : "factor of a tilt", kNotNegative, value)) return false;
  }
  return true;
}

/// The ten numbers and the three.
bool IesReading::read_sizes() {
  double lamps = 0, lumens = 0, multiplier = 0, type = 0, unused = 0, ballast = 0, factor = 0;
  Token at;
  if (!number("lamps", kAnyNumber, lamps) || !number("lumens a lamp", kAnyNumber, lumens) ||
      !number("multiplier of candelas", kNotNegative, multiplier) || !count("vertical angles", verticals_) ||
      !count("horizontal angles", horizontals_) || !number("photometric type", {1, 3}, type, &at)) {
    return false;
  }
  if (type != 1) return expected(at, "photometry of type 1 (C), as types 2 (B) and 3 (A) are not read");
  if (!number("units, 1 feet or 2 metres", {1, 2}, unused)) return false;
  for (const std::string_view size : {"width", "length", "height"}) {
    if (!number(size, kAnyNumber, unused)) return false;
  }
  const Interval factors = old_ ? kNotNegative : kAnyNumber;  // later it may be a code
  if (!number("ballast factor", kNotNegative, ballast) || !number("photometric factor", factors, factor) ||
      !number("watts", kAnyNumber, unused)) {
    return false;
  }
  scale_ = multiplier * ballast * (old_ ? factor : 1);
  return true;
}

/// Above `last` if there is one, and so as a float too: no two angles of the table are one.
bool IesReading::next_angle(std::string_view what, double most, const float* last, float& angle, Token& at) {
  double value = 0;
  if (!number(what, {0, most}, value, &at)) return false;
  angle = static_cast<float>(value);
  return last == nullptr || angle > *last || expected(at, "angles that ascend");
}

bool IesReading::read_verticals(std::span<float> angles) {
  float last = 0;
  for (std::size_t k = 0; k < verticals_; ++k) {
    float angle = 0;
    Token at;
    if (!next_angle("vertical angle", 180, k > 0 ? &last : nullptr, angle, at)) return false;
    if (k == 0 && angle != 0 && angle != 90) return expected(at, "a first vertical angle of 0 or 90");
    if (k + 1 == verticals_ && ((angle != 90 && angle != 180) || k == 0)) {
      return expected(at, "a last vertical angle of 90 or 180");
    }
    if (!angles.empty()) angles[k] = angle;
    last = angle;
  }
  return true;
}

/// Which part of the circle the half-planes stand for follows from the first and the last.
bool IesReading::read_horizontals(std::span<float> angles) {
  float last = 0, before = 0, first = 0;
  Token at;
  for (std::size_t k = 0; k < horizontals_; ++k) {
    float angle = 0;
    if (!next_angle("horizontal angle", 360, k > 0 ? &last : nullptr, angle, at)) return false;
    if (k == 0) first = angle;
    if (!angles.empty()) angles[k] = angle;
    before = last;
    last = angle;
  }
  const double step = static_cast<double>(last) - static_cast<double>(before);
  const double gap = 360 - static_cast<double>(last) - step;
  closes_ = first == 0 && last > 180 && last < 360 && gap <= kSameStep && gap >= -kSameStep;
  if (closes_ && !angles.empty()) angles[horizontals_] = 360;
  const bool whole = last == 0 || last == 90 || last == 180 || last == 360 || closes_;
  if ((first == 90 && last == 270) || (first == 0 && whole)) return true;
  if (first != 0) return expected(at, "horizontal angles from 0, or from 90 to 270");
  return expected(at, "a last horizontal angle of 0, 90, 180 or 360, or one step less than 360");
}

bool IesReading::read_candelas(std::span<float> candela) {
  const std::size_t all = verticals_ * horizontals_;
  for (std::size_t k = 0; k < all; ++k) {
    const Token at = text_.word();
    if (at.kind != TokenKind::kWord) {
      mistake(at).add("expected ").add(all).add(" candelas (").add(verticals_).add(" x ").add(horizontals_)
          .add("), found ").add(k);
      return false;
    }
    const DecimalResult result = parse_decimal(at.text);
    const double value = result.value * scale_;
    if (result.error != DecimalError::none || !(value >= 0 && value <= kLargestNumber)) {
      return expected(at, "an intensity from 0 to 1e30 cd");
    }
    if (!candela.empty()) candela[k] = static_cast<float>(value);
  }
  for (std::size_t k = 0; k < verticals_ && closes_ && !candela.empty(); ++k) candela[all + k] = candela[k];
  return true;
}

bool IesReading::read(Luminaire& luminaire, std::span<float> vertical, std::span<float> horizontal,
                      std::span<float> candela) {
  return read_head(luminaire) && read_sizes() && read_verticals(vertical) &&
         read_horizontals(horizontal) && read_candelas(candela);
}

/// Its part of the circle that the half-planes stand for: half of the angle between its neighbours.
double plane_weight(const Luminaire& luminaire, std::size_t k) {
  const std::span<const float> at = luminaire.horizontal;
  if (at.size() == 1) return 1;
  const double low = static_cast<double>(at[k > 0 ? k - 1 : 0]);
  const double high = static_cast<double>(at[k + 1 < at.size() ? k + 1 : k]);
  return 0.5 * (high - low) / static_cast<double>(at[at.size() - 1] - at[0]);
}

/// Along the axis all half-planes are one direction: the v-th vertical angle is 0 or 180.
void share_pole(Luminaire& luminaire, std::span<float> candela, std::size_t v) {
  const std::size_t verticals = luminaire.vertical.size();
  double mean = 0, least = kInfinity, most = 0;
  for (std::size_t k = 0; k < luminaire.horizontal.size(); ++k) {
    const double here = static_cast<double>(candela[k * verticals + v]);
    mean += plane_weight(luminaire, k) * here;
    least = here < least ? here : least;
    most = here > most ? here : most;
  }
  if (most - least > kSamePole * most) luminaire.poles_differ = true;
  for (std::size_t k = 0; k < luminaire.horizontal.size(); ++k) candela[k * verticals + v] = static_cast<float>(mean);
}

/// Of what is between the angles, linear in V: its integral over V, times sin V, is exact.
double flux_of(const Luminaire& luminaire) {
  const std::size_t verticals = luminaire.vertical.size();
  double sum = 0;
  for (std::size_t k = 0; k < luminaire.horizontal.size(); ++k) {
    double plane = 0;
    for (std::size_t v = 0; v + 1 < verticals; ++v) {
      const double from = static_cast<double>(luminaire.vertical[v]);
      const double to = static_cast<double>(luminaire.vertical[v + 1]);
      const double first = static_cast<double>(luminaire.candela[k * verticals + v]);
      const double second = static_cast<double>(luminaire.candela[k * verticals + v + 1]);
      const double slope = (second - first) / (kRadiansPerDegree * (to - from));
      plane += first * cosine_degrees(from) - second * cosine_degrees(to) +
               slope * (sine_degrees(to) - sine_degrees(from));
    }
    sum += plane_weight(luminaire, k) * plane;
  }
  return kTwoPi * sum;
}

bool read_table(std::string_view text, Luminaire& luminaire, Arena& arena, Status& status) {
  IesReading sizes(luminaire.path, text, status);
  if (!sizes.read(luminaire)) return false;
  const std::size_t verticals = sizes.verticals(), horizontals = sizes.horizontals();
  std::span<float> all;
  if (!arena.take("luminaire", verticals + horizontals + verticals * horizontals, all)) {
    return status = arena.refused(), false;
  }
  const std::span<float> vertical = all.first(verticals), horizontal = all.subspan(verticals, horizontals),
                         candela = all.subspan(verticals + horizontals);
  if (!IesReading(luminaire.path, text, status).read(luminaire, vertical, horizontal, candela)) return false;
  luminaire.vertical = vertical;
  luminaire.horizontal = horizontal;
  luminaire.candela = candela;
  if (vertical[0] == 0) share_pole(luminaire, candela, 0);
  if (vertical[verticals - 1] == 180) share_pole(luminaire, candela, verticals - 1);
  luminaire.lumens = flux_of(luminaire);
  return true;
}

/// Another luminaire that has the same file and was read before.
const Luminaire* same_file(const Scene& scene, std::uint32_t k) {
  for (std::uint32_t other = 0; other < k; ++other) {
    if (scene.luminaires[other].path == scene.luminaires[k].path) return &scene.luminaires[other];
  }
  return nullptr;
}

/// What other parts ask of a light: its largest intensity, and the exponent of a cos^n of the same and the same flux.
void describe(const Luminaire& luminaire, Light& light) {
  double most = 0;
  for (const float candela : luminaire.candela) {
    const double here = static_cast<double>(candela);
    most = here > most ? here : most;
  }
  light.strength = most;
  const double exponent = luminaire.lumens > 0 ? kTwoPi * most / luminaire.lumens - 1 : 0;
  light.cosine_exponent = exponent < kMostExponent ? exponent : kMostExponent;
}

}  // namespace

bool load_luminaires(Scene& scene, const Reader& reader, Arena& arena, Status& status, std::uint32_t& at) {
  for (at = 0; at < scene.luminaires.size(); ++at) {
    Luminaire& luminaire = scene.luminaires[at];
    if (const Luminaire* const same = same_file(scene, at); same != nullptr) {
      const Luminaire mine = luminaire;
      luminaire = *same;
      luminaire.light = mine.light;
      luminaire.along = mine.along;
      luminaire.across = mine.across;
    } else {
      std::string_view text;
      if (reader.read == nullptr || !reader.read(reader.context, luminaire.path, text)) {
        status = {};
        status.code = StatusCode::kFile;
        MessageText(status.message, sizeof status.message)
            .add("expected an IES file that can be read, found ").add(luminaire.path);
        return false;
      }
      if (!read_table(text, luminaire, arena, status)) return false;
    }
    describe(luminaire, scene.lights[luminaire.light]);
  }
  return true;
}

}  // namespace shodo
