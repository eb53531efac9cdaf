// How far a map is from the truth, which is known as two independent estimates a and b of each sub-patch: the mean of
// (x - a)(x - b) is that of (x - truth)^2, whatever the noise; so is that of (x - a)(y - b), where x and y are two
// estimates themselves. doc/report.md has the measures.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <tuple>
#include <vector>

namespace shodo::truth {

/// Mesh, v, u; u of a triangle's sub-patch as tables count it: 2 u, and 1 more for one that stands on its tip.
using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;

/// Both kinds of light, by channel. Of a truth there are two estimates, of a map twice the same.
struct Row {
  std::string object;
  bool triangle = false;
  double area = 0, seen_area = 0;
  double ambient[2][3] = {}, direct[2][3] = {};
};
using Table = std::map<Key, Row>;

inline std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields;
  std::istringstream stream(line);
  for (std::string field; std::getline(stream, field, ',');) fields.push_back(field);
  return fields;
}

template <class Take>
void for_lines(const std::string& text, std::size_t least, Take take) {
  std::istringstream stream(text);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line)) {
    const std::vector<std::string> fields = fields_of(line);
    if (fields.size() >= least) take(fields);
  }
}

inline double number(const std::string& text) { return std::strtod(text.c_str(), nullptr); }
inline std::uint32_t count(const std::string& text) {
  return static_cast<std::uint32_t>(std::strtoul(text.c_str(), nullptr, 10));
}

inline constexpr const char* kTruthHead =
    "object,mesh,u,v,kind,area,visible_area,ambient_a_r,ambient_a_g,ambient_a_b,ambient_b_r,ambient_b_g,ambient_b_b,"
    "direct_a_r,direct_a_g,direct_a_b,direct_b_r,direct_b_g,direct_b_b";

inline Table read_truth(const std::string& text) {
  Table table;
  for_lines(text, 19, [&](const std::vector<std::string>& f) {
    Row row{f[0], f[4] == "tri", number(f[5]), number(f[6]), {}, {}};
    for (std::size_t c = 0; c < 6; ++c) row.ambient[c / 3][c % 3] = number(f[7 + c]);
    for (std::size_t c = 0; c < 6; ++c) row.direct[c / 3][c % 3] = number(f[13 + c]);
    bool both = true;  // one estimate may see nothing of what is all but hidden
    for (const double* half : {row.ambient[0], row.ambient[1]}) both = both && half[0] + half[1] + half[2] > 0;
    if (!both && row.seen_area < 0.05 * row.area) row.seen_area = 0;
    table[{count(f[1]), count(f[3]), count(f[2])}] = row;
  });
  return table;
}

/// The sub-patch of the scene's own that holds one of a map `factor` times as fine.
inline Key coarser(std::uint32_t mesh, std::uint32_t u, std::uint32_t v, bool triangle, std::uint32_t factor) {
  if (!triangle) return {mesh, v / factor, u / factor};
  const std::uint32_t column = u / 2, tip = u % 2;
  const bool beyond = column % factor + v % factor + tip >= factor;
  return {mesh, v / factor, 2 * (column / factor) + (beyond ? 1 : 0)};
}

/// A map's values, averaged over the area that has any: what is hidden has no light of either kind.
inline Table read_map(const std::string& text, const Table& truth, std::uint32_t factor) {
  std::map<std::uint32_t, bool> triangles;
  for (const auto& [key, row] : truth) triangles[std::get<0>(key)] = row.triangle;
  Table table;
  for_lines(text, 16, [&](const std::vector<std::string>& f) {
    const std::uint32_t mesh = count(f[1]);
    const auto kind = triangles.find(mesh);
    if (kind == triangles.end()) return;  // a measuring plane
    Row& row = table[coarser(mesh, count(f[2]), count(f[3]), kind->second, factor)];
    const double area = number(f[10]);
    double lux[6], sum = 0;
    for (std::size_t c = 0; c < 6; ++c) lux[c] = number(f[11 + c]), sum += lux[c];
    row.object = f[0];
    row.area += area;
    if (!(sum > 0)) return;
    row.seen_area += area;
    for (std::size_t c = 0; c < 3; ++c) row.direct[0][c] += area * lux[c], row.ambient[0][c] += area * lux[c + 3];
  });
  for (auto& [key, row] : table) {
    for (std::size_t c = 0; c < 3 && row.seen_area > 0; ++c) {
      row.direct[0][c] = row.direct[1][c] = row.direct[0][c] / row.seen_area;
      row.ambient[0][c] = row.ambient[1][c] = row.ambient[0][c] / row.seen_area;
    }
  }
  return table;
}

/// A truth's or a map's.
inline Table read_light(const std::string& text, const Table& truth, std::uint32_t factor) {
  const bool traced = text.compare(0, text.find('\n'), kTruthHead) == 0;
  return traced ? read_truth(text) : read_map(text, truth, factor);
}

/// One sub-patch compared.
struct Compared {
  Key key;
  std::string object;
  double area = 0;
  double square = 0;    // mean over channels of (x - a)(y - b)
  double off = 0;       // mean over channels of (x + y) / 2 - (a + b) / 2
  double apparent = 0;  // root mean square of it
  double noise = 0;     // variance of the square
  double truth = 0, map = 0, doubt = 0;  // means over channels; doubt: half of |a - b|
};

using Lux = double[2][3];
inline Compared compared(const Key& key, const Row& row, const Lux& truth, const Lux& map) {
  Compared one{key, row.object, row.seen_area};
  double spread = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const double p = map[0][c] - truth[0][c], q = map[1][c] - truth[1][c];
    const double a = truth[0][c], b = truth[1][c];
    one.square += p * q / 3;
    one.off += 0.5 * (p + q) / 3;
    one.apparent += 0.25 * (p + q) * (p + q) / 3;
    spread += (p - q) * (p - q) / 3;
    one.truth += 0.5 * (a + b) / 3;
    one.map += 0.5 * (map[0][c] + map[1][c]) / 3;
    one.doubt += 0.5 * (a - b) / 3;
  }
  one.apparent = std::sqrt(one.apparent);
  // Of each factor the variance is s2 = (p - q)^2 / 2: that of the product is 2 e^2 s2 + s2^2, and (p - q)^4 has the
  // mean 12 s2^2.
  one.noise = spread * std::max(0.0, one.square) + spread * spread / 12;
  one.doubt = std::abs(one.doubt);
  return one;
}

struct Sums {
  double area = 0, square = 0, off = 0, noise = 0, truth = 0;
  void add(const Compared& one) {
    area += one.area;
    square += one.area * one.square;
    off += one.area * one.off;
    noise += one.area * one.area * one.noise;
    truth += one.area * one.truth;
  }
};

template <class... Values>
std::string line(const char* format, Values... values) {
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/// In % of a mean; what it may be off by noise, one standard deviation.
inline std::string rms(const Sums& sums, double mean) {
  const double value = std::sqrt(std::max(0.0, sums.square / sums.area));
  const double noise = std::sqrt(sums.noise) / sums.area;
  const double off = value > 0 ? std::min(noise / (2 * value), std::sqrt(noise)) : std::sqrt(noise);
  return line("%.2f +- %.2f %%", 100 * value / mean, 100 * off / mean);
}

/// What one kind of light is off.
inline std::string told(const char* kind, std::vector<Compared> all, double mean, bool objects_too, std::size_t worst) {
  Sums sums, best;
  for (const Compared& one : all) sums.add(one);
  std::sort(all.begin(), all.end(), [](const Compared& x, const Compared& y) {
    return x.apparent != y.apparent ? x.apparent > y.apparent : x.key < y.key;
  });
  double passed = 0;
  for (const Compared& one : all) {
    if (passed >= 0.01 * sums.area) best.add(one);
    passed += one.area;
  }
  std::string text = std::string("  ") + kind + " error " + rms(sums, mean) + ", of the best 99 % of the area about " +
                     rms(best, mean) + line(", bias %+.3f %%, truth %.2f lx\n", 100 * sums.off / sums.area / mean,
                                            sums.truth / sums.area);
  std::map<std::string, Sums> objects;
  for (const Compared& one : all) objects[one.object].add(one);
  std::vector<std::pair<std::string, Sums>> order(objects.begin(), objects.end());
  std::sort(order.begin(), order.end(),
            [](const auto& x, const auto& y) { return x.second.square > y.second.square; });
  for (std::size_t k = 0; k < order.size() && k < 10 && objects_too; ++k) {
    const Sums& s = order[k].second;
    text += line("    %-18s %5.1f +- %.1f %% of the squares, %4.1f %% of the area, bias %+.2f %% of the mean\n",
                 order[k].first.c_str(), 100 * s.square / sums.square, 100 * std::sqrt(s.noise) / std::abs(sums.square),
                 100 * s.area / sums.area, 100 * s.off / s.area / mean);
  }
  std::sort(all.begin(), all.end(), [](const Compared& x, const Compared& y) {
    const double p = x.area * x.square, q = y.area * y.square;
    return p != q ? p > q : x.key < y.key;
  });
  for (std::size_t k = 0; k < all.size() && k < worst; ++k) {
    const Compared& one = all[k];
    text += line("      %5.2f %% %s mesh %u u %u v %u: map %.1f truth %.1f +- %.1f lx, %.4f square units\n",
                 100 * one.area * one.square / sums.square, one.object.c_str(), std::get<0>(one.key),
                 std::get<2>(one.key), std::get<1>(one.key), one.map, one.truth, one.doubt, one.area);
  }
  return text;
}

inline std::string comparison(const std::string& name, const Table& truth, const Table& map, std::size_t worst) {
  std::vector<Compared> ambient, direct;
  double area = 0, total = 0, left_out = 0, lit = 0;
  for (const auto& [key, row] : truth) {
    const auto found = map.find(key);
    const bool has = found != map.end() && found->second.seen_area > 0;
    if (!(row.seen_area > 0)) {
      lit += has ? found->second.seen_area : 0;
      continue;
    }
    if (!has) {
      left_out += row.seen_area;
      continue;
    }
    ambient.push_back(compared(key, row, row.ambient, found->second.ambient));
    direct.push_back(compared(key, row, row.direct, found->second.direct));
    area += row.seen_area;
    total += row.seen_area * (ambient.back().truth + direct.back().truth);
  }
  if (ambient.empty()) return name + ": nothing to compare\n";
  const double mean = total / area;
  return name +
         line(": in %% of the mean, %.2f lx; area without a value %.3f %%, with one where all is hidden %.3f %%\n",
              mean, 100 * left_out / area, 100 * lit / area) +
         told("ambient", ambient, mean, true, worst) + told("direct ", direct, mean, false, worst / 4);
}

}  // namespace shodo::truth
