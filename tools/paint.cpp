// Paints the textures of data/textures: nothing there comes from elsewhere. The same bytes everywhere: whole numbers for
// noise, + - * / for the rest, no library functions.
//   c++ -std=c++20 -ffp-contract=off tools/paint.cpp -o paint && ./paint data/textures
#include <cstdint>
#include <cstdio>
#include <string>
#include <vector>

namespace {

struct Colour {
  double r = 0, g = 0, b = 0;
};
Colour operator*(double k, const Colour& c) { return {k * c.r, k * c.g, k * c.b}; }
Colour operator+(const Colour& a, const Colour& b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
Colour mixed(const Colour& a, const Colour& b, double t) { return (1 - t) * a + t * b; }

double clamped(double x) { return x < 0 ? 0 : x > 1 ? 1 : x; }
double smooth(double x) { return clamped(x) * clamped(x) * (3 - 2 * clamped(x)); }
/// 0 below a, 1 above b.
double step(double a, double b, double x) { return smooth((x - a) / (b - a)); }
double floor_of(double x) {
  const double whole = static_cast<double>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1 : whole;
}
double magnitude(double x) { return x < 0 ? -x : x; }

/// A number from 0 to 1 for two whole ones.
double random(std::int64_t x, std::int64_t y, std::uint32_t seed) {
  std::uint32_t h = static_cast<std::uint32_t>(x) * 0x9e3779b1u + static_cast<std::uint32_t>(y) * 0x85ebca77u + seed;
  for (int k = 0; k < 2; ++k) {
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
  }
  return static_cast<double>(h >> 8) / 16777216.0;
}

/// Noise between whole places; it repeats after `period` of them if that is above 0.
double noise(double x, double y, std::uint32_t seed, std::int64_t period_x = 0, std::int64_t period_y = 0) {
  const double i = floor_of(x), j = floor_of(y), u = smooth(x - i), v = smooth(y - j);
  const auto at = [&](std::int64_t a, std::int64_t b) {
    if (period_x > 0) a = (a % period_x + period_x) % period_x;
    if (period_y > 0) b = (b % period_y + period_y) % period_y;
    return random(a, b, seed);
  };
  const auto a = static_cast<std::int64_t>(i), b = static_cast<std::int64_t>(j);
  const double low = at(a, b) * (1 - u) + at(a + 1, b) * u, high = at(a, b + 1) * (1 - u) + at(a + 1, b + 1) * u;
  return low * (1 - v) + high * v;
}

double cloud(double x, double y, std::uint32_t seed) {
  return 0.5 * noise(x, y, seed) + 0.25 * noise(2 * x, 2 * y, seed + 1) + 0.15 * noise(4 * x, 4 * y, seed + 2) +
         0.1 * noise(8 * x, 8 * y, seed + 3);
}

// Patterns: x and y from 0 to 1, y downwards; values are 8-bit sRGB over 255. Those of one value are grey.

/// Six boards side by side, each of two lengths; the grain runs along y. Repeats both ways.
Colour planks(double x, double y) {
  const double board = floor_of(6 * x), across = 6 * x - board;
  const double start = random(static_cast<std::int64_t>(board), 0, 11);
  const double along = y + start - floor_of(y + start);
  const double half = along < 0.5 ? 0 : 1, length = 2 * along - half;
  const std::int64_t which = static_cast<std::int64_t>(2 * board + half);
  const double tone = 0.69 + 0.10 * random(which, 1, 12);
  const double grain = noise(5 * across + 37.0 * static_cast<double>(which), 3 * along, 13) - 0.5;
  const double fine = noise(14 * across + 53.0 * static_cast<double>(which), 9 * along, 14) - 0.5;
  const double edge = across < 0.5 ? across : 1 - across, end = length < 0.5 ? length : 1 - length;
  const double gap = (0.62 + 0.38 * step(0, 0.09, edge)) * (0.72 + 0.28 * step(0, 0.012, end));
  const double value = (tone + 0.13 * grain + 0.08 * fine) * gap;
  return {value, value, value};
}

/// Plain weave over cloudy dye. Repeats both ways.
Colour cloth(double x, double y) {
  const double u = 16 * x, v = 16 * y;
  const bool over = (static_cast<std::int64_t>(u) + static_cast<std::int64_t>(v)) % 2 == 0;
  const double thread = over ? u - floor_of(u) : v - floor_of(v);
  const double bulge = 4 * thread * (1 - thread);
  const double dye = noise(5 * x, 5 * y, 21, 5, 5) - 0.5, fibre = noise(32 * x, 32 * y, 22, 32, 32) - 0.5;
  const double value = 0.73 + 0.07 * bulge + (over ? 0.03 : 0) + 0.07 * dye + 0.08 * fibre;
  return {value, value, value};
}

/// Wood, the grain along y. Repeats both ways.
Colour wood(double x, double y) {
  const double bend = 0.10 * noise(2 * x, 3 * y, 31, 2, 3);
  const double rings = 9 * (x + bend), part = rings - floor_of(rings);
  const double ring = part < 0.8 ? part / 0.8 : (1 - part) / 0.2;
  const double pores = noise(60 * x, 12 * y, 32, 60, 12) - 0.5;
  const double value = 0.62 + 0.09 * ring + 0.10 * pores;
  return {value, value, value};
}

/// A field of small lozenges with a medallion, for the middle of the rug; the long way along y; drawn once.
Colour rug(double y, double x) {
  const Colour red{0.62, 0.20, 0.15}, dark{0.33, 0.10, 0.12}, blue{0.16, 0.20, 0.36}, sand{0.80, 0.66, 0.45};
  const double u = 2 * x - 1, v = 2 * y - 1, au = magnitude(u), av = magnitude(v);
  Colour c = red;
  const double i = 12 * u + 0.5, j = 9 * v + 0.5;
  const double lozenge = magnitude(i - floor_of(i) - 0.5) + magnitude(j - floor_of(j) - 0.5);
  c = mixed(sand, c, step(0.12, 0.20, lozenge));
  const double medallion = au / 0.58 + av / 0.72;
  c = mixed(dark, c, step(0.99, 1.01, medallion));
  c = mixed(sand, c, step(0.93, 0.95, medallion));
  c = mixed(blue, c, step(0.87, 0.89, medallion));
  c = mixed(red, c, step(0.60, 0.62, medallion));
  c = mixed(sand, c, step(0.34, 0.36, medallion));
  c = mixed(dark, c, step(0.27, 0.29, medallion));
  const double from_edge = (1 - au) * 1.3 < 1 - av ? (1 - au) * 1.3 : 1 - av;
  c = mixed(blue, c, step(0.135, 0.15, from_edge));
  const double k = 14 * (1 - au < 1 - av ? v : u), tooth = magnitude(k - floor_of(k) - 0.5);
  c = mixed(sand, c, from_edge < 0.14 ? step(0.16, 0.22, tooth + 3 * magnitude(from_edge - 0.07)) : 1);
  c = mixed(sand, c, step(0.02, 0.03, from_edge));
  return (0.93 + 0.14 * noise(40 * x, 30 * y, 41)) * c;
}

/// A picture of a coast in the evening, as if painted.
Colour coast(double x, double y) {
  const double brush = noise(20 * x, 60 * y, 51) - 0.5;
  Colour c = mixed({0.42, 0.58, 0.74}, {0.95, 0.83, 0.66}, smooth(y / 0.55));
  const double clouds = cloud(3 * x, 9 * y, 52);
  c = mixed(c, {0.97, 0.90, 0.82}, step(0.48, 0.68, clouds) * 0.8);
  const double su = (x - 0.71) * 1.5, sv = y - 0.36, sun = su * su + sv * sv;
  c = mixed({1.0, 0.86, 0.50}, c, step(0.0035, 0.005, sun));
  c = mixed(c, {1.0, 0.85, 0.55}, 0.4 * (1 - step(0.0, 0.12, sun)));
  const double horizon = 0.56;
  const double hill = 0.40 + 0.5 * x * x + 0.05 * noise(7 * x, 0, 53) + 0.02 * noise(30 * x, 0, 54);
  if (y > hill && y < horizon + 0.02) {
    c = mixed({0.36, 0.42, 0.44}, {0.22, 0.34, 0.26}, (y - hill) / 0.16) + 0.06 * brush * Colour{1, 1, 1};
  }
  if (y >= horizon) {
    const double depth = (y - horizon) / (1 - horizon);
    const double wave = noise(6 * x + 3 * y, 10 + 26 * depth * (1 - 0.4 * depth), 55);
    c = mixed({0.45, 0.58, 0.66}, {0.12, 0.34, 0.46}, depth * 1.3 < 1 ? depth * 1.3 : 1);
    c = mixed(c, {0.74, 0.82, 0.84}, 0.5 * step(0.62, 0.8, wave));
    const double glint = (x - 0.71) / (0.03 + 0.10 * depth);
    c = mixed(c, {1.0, 0.88, 0.62}, 0.7 * (1 - smooth(magnitude(glint))) * step(0.45, 0.7, wave));
  }
  const double shore = 0.80 + 0.10 * x + 0.02 * noise(8 * x, 3, 56);
  c = mixed(c, {0.92, 0.92, 0.88}, step(shore - 0.03, shore - 0.01, y));
  c = mixed(c, mixed({0.78, 0.68, 0.50}, {0.62, 0.50, 0.34}, (y - shore) / 0.2), step(shore, shore + 0.015, y));
  return c + 0.05 * brush * Colour{1, 1, 1};
}

/// Windows of a house: 0 outside, 1 within the k-th.
bool in_box(double x, double y, double left, double top, double right, double bottom) {
  return x > left && x < right && y > top && y < bottom;
}

/// Leaves of a crown about (cx, cy): 0 outside.
double crown(double x, double y, double cx, double cy, double rx, double ry, std::uint32_t seed) {
  const double u = (x - cx) / rx, v = (y - cy) / ry;
  return 1 - step(0.72, 1.0, u * u + v * v + 0.9 * (noise(36 * x, 24 * y, seed) - 0.5));
}

struct House {
  Colour wall, shade, roof, window;
};

/// The house opposite; true if (x, y) lies on it. Its end wall is in the shade.
bool house(double x, double y, const House& paint, Colour& c) {
  const double eaves = 0.235, foot = 0.60, ridge = 0.06;
  const bool roof = y < eaves && y > ridge && x > 0.515 + 0.10 * (eaves - y) / (eaves - ridge) && x < 0.97;
  const bool wall = in_box(x, y, 0.53, eaves, 0.96, foot);
  if (in_box(x, y, 0.83, 0.015, 0.87, 0.12)) c = 0.8 * paint.roof;
  if (roof) c = (0.92 + 0.16 * noise(60 * x, 90 * y, 61)) * paint.roof;
  if (wall) {
    c = x < 0.60 ? paint.shade : paint.wall;
    if (y < eaves + 0.025) c = 0.75 * c;
    for (int k = 0; k < 4; ++k) {
      const double left = 0.64 + 0.08 * k;
      for (int floor = 0; floor < 2; ++floor) {
        const double top = floor == 0 ? 0.29 : 0.45;
        if (in_box(x, y, left - 0.005, top - 0.008, left + 0.045, top + 0.098)) c = 1.05 * paint.wall;
        if (in_box(x, y, left, top, left + 0.04, top + 0.09)) c = paint.window;
        if (in_box(x, y, left + 0.0175, top, left + 0.0225, top + 0.09)) c = 1.05 * paint.wall;
      }
    }
  }
  return roof || wall;
}

/// What stands outside the window by day: lawn, hedge, trees, a house, hills, sky.
Colour garden(double x, double y) {
  const double horizon = 0.40;
  Colour c = mixed({0.40, 0.60, 0.88}, {0.80, 0.88, 0.95}, clamped(y / horizon));
  c = mixed(c, {0.97, 0.97, 0.97}, step(0.46, 0.66, cloud(3.2 * x + 0.4, 7 * y, 71)));
  const double hill = 0.33 + 0.05 * noise(4 * x + 1, 0, 72) - 0.04 * x;
  c = mixed(c, {0.52, 0.62, 0.66}, step(hill, hill + 0.012, y));
  const double wood_line = 0.37 + 0.03 * noise(26 * x, 0, 73);
  c = mixed(c, (0.9 + 0.3 * noise(50 * x, 40 * y, 74)) * Colour{0.30, 0.42, 0.30}, step(wood_line, wood_line + 0.01, y));
  house(x, y, {{0.93, 0.89, 0.78}, {0.66, 0.66, 0.66}, {0.66, 0.32, 0.22}, {0.26, 0.32, 0.38}}, c);
  const double tree = crown(x, y, 0.20, 0.20, 0.19, 0.21, 75);
  if (in_box(x, y, 0.19, 0.3, 0.215, 0.62)) c = {0.34, 0.27, 0.20};
  const double leaves = noise(44 * x, 34 * y, 76);
  c = mixed(c, mixed({0.20, 0.32, 0.12}, {0.55, 0.66, 0.24}, leaves * (1.25 - y)), tree);
  const double hedge = 0.52 + 0.015 * noise(30 * x, 0, 77);
  if (y > hedge) c = mixed({0.34, 0.46, 0.20}, {0.14, 0.24, 0.10}, (y - hedge) / 0.12) + 0.16 * (noise(70 * x, 60 * y, 78) - 0.5) * Colour{1, 1, 1};
  const double lawn = 0.635;
  if (y > lawn) {
    const double stripe = noise(40 * (x - 0.5) / (y - 0.40), 1, 79);
    c = mixed({0.46, 0.60, 0.26}, {0.36, 0.52, 0.18}, clamped((y - lawn) / (1 - lawn)));
    c = (0.94 + 0.12 * stripe + 0.10 * (noise(60 * x, 160 * y, 80) - 0.5)) * c;
    const double shade = (x - 0.24 - 0.5 * (y - lawn)) / 0.20, low = (y - lawn - 0.05) / 0.05;
    c = (1 - 0.42 * (1 - step(0.5, 1.1, shade * shade + low * low))) * c;
  }
  return c;
}

/// The same at night: a few lit windows, a street lamp, the glow of a town.
Colour night(double x, double y) {
  const double horizon = 0.40;
  Colour c = mixed({0.02, 0.03, 0.07}, {0.10, 0.10, 0.15}, clamped(y / horizon));
  const double sx = floor_of(80 * x), sy = floor_of(48 * y);
  if (y < 0.3 && random(static_cast<std::int64_t>(sx), static_cast<std::int64_t>(sy), 81) > 0.985) c = {0.45, 0.45, 0.5};
  const double hill = 0.33 + 0.05 * noise(4 * x + 1, 0, 72) - 0.04 * x;
  c = mixed(c, {0.04, 0.045, 0.06}, step(hill, hill + 0.012, y));
  for (int k = 0; k < 9; ++k) {
    const double u = (x - 0.02 - 0.5 * random(k, 0, 82)) / 0.006, v = (y - 0.375 - 0.03 * random(k, 1, 82)) / 0.01;
    if (u * u + v * v < 1) c = k % 3 == 0 ? Colour{0.85, 0.6, 0.3} : Colour{0.9, 0.75, 0.5};
  }
  const Colour wall{0.06, 0.06, 0.075};
  house(x, y, {wall, {0.04, 0.04, 0.05}, {0.03, 0.03, 0.04}, {0.03, 0.035, 0.05}}, c);
  if (in_box(x, y, 0.72, 0.45, 0.76, 0.54) || in_box(x, y, 0.80, 0.45, 0.84, 0.54)) c = {1.0, 0.80, 0.46};
  if (in_box(x, y, 0.88, 0.29, 0.92, 0.38)) c = {0.75, 0.62, 0.42};
  c = mixed(c, {0.02, 0.025, 0.025}, crown(x, y, 0.20, 0.20, 0.19, 0.21, 75));
  const double hedge = 0.52 + 0.015 * noise(30 * x, 0, 77);
  if (y > hedge && !in_box(x, y, 0.74, 0.45, 0.75, 0.54)) c = {0.025, 0.03, 0.03};
  const double lamp_u = (x - 0.42) / 0.013, lamp_v = (y - 0.33) / 0.02, lamp = lamp_u * lamp_u + lamp_v * lamp_v;
  if (in_box(x, y, 0.417, 0.33, 0.423, 0.56)) c = {0.08, 0.08, 0.08};
  c = c + (0.5 / (1 + 0.35 * lamp)) * Colour{0.9, 0.8, 0.6};
  if (lamp < 1) c = {1, 0.95, 0.8};
  if (y > 0.635) {
    const double u = (x - 0.42) / 0.30, v = (y - 0.66) / 0.07;
    c = mixed({0.04, 0.05, 0.035}, {0.15, 0.16, 0.09}, 1 - step(0.0, 1.2, u * u + v * v));
    const double fall = (x - 0.78) / 0.12, deep = (y - 0.70) / 0.10;
    c = c + 0.16 * (1 - step(0.2, 1.2, fall * fall + deep * deep)) * Colour{0.9, 0.7, 0.4};
  }
  return c;
}

/// Area means of 4 x 4 samples a texel; PGM where it is grey.
bool write(const std::string& folder, const char* name, int width, int height, bool grey, Colour (*paint)(double, double)) {
  std::vector<unsigned char> bytes;
  const auto byte = [](double value) { return static_cast<unsigned char>(255 * clamped(value) + 0.5); };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      Colour sum;
      for (int k = 0; k < 16; ++k) {
        sum = sum + paint((x + (k % 4 + 0.5) / 4) / width, (y + (k / 4 + 0.5) / 4) / height);
      }
      bytes.push_back(byte(sum.r / 16));
      if (grey) continue;
      bytes.push_back(byte(sum.g / 16));
      bytes.push_back(byte(sum.b / 16));
    }
  }
  std::FILE* const file = std::fopen((folder + "/" + name).c_str(), "wb");
  if (file == nullptr) return false;
  std::fprintf(file, "P%d\n%d %d\n255\n", grey ? 5 : 6, width, height);
  const bool written = std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size();
  return std::fclose(file) == 0 && written;
}

}  // namespace

int main(int count, char** words) {
  if (count != 2) return std::fprintf(stderr, "paint: expected a folder\n"), 2;
  const std::string folder = words[1];
  const bool done = write(folder, "planks.pgm", 96, 64, true, planks) && write(folder, "cloth.pgm", 64, 64, true, cloth) &&
                    write(folder, "wood.pgm", 32, 64, true, wood) && write(folder, "rug.ppm", 44, 66, false, rug) &&
                    write(folder, "coast.ppm", 64, 38, false, coast) &&
                    write(folder, "garden.ppm", 160, 96, false, garden) &&
                    write(folder, "night.ppm", 64, 38, false, night);
  return done ? 0 : 1;
}
