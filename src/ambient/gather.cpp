#include "ambient/gather.h"

#include "ambient/gathered_sums.h"
#include "ambient/sent_light.h"
#include "ambient/sub_patch_finder.h"
#include "ambient/visible_part.h"
#include "base/elementary.h"
#include "base/interrupted.h"
#include "scene/sub_patches.h"
#include "visibility/line_bundle.h"

namespace shodo {

namespace {

constexpr double kBundles = 16;             // times the square root of a sub-patch's lines
constexpr std::uint32_t kPriorLines = 16;   // for which the interpolated value counts
constexpr std::uint32_t kUpdates = 4;       // of what is sent: halfway, at a quarter, and so on
constexpr double kMostOfMeshes = 16;        // area of all that lines cross, area lights too, of the meshes'
constexpr double kGolden = 0x1.3c6ef372fe95p-1, kShift = 0x1.a827999fcef34p-2;  // 1 / 1.618..., sqrt(2) - 1

double fraction(double x) { return x - static_cast<double>(static_cast<std::int64_t>(x)); }

struct Memory {
  SubPatchFinder finder;
  SentLight sent;
  GatheredSums sums;
};

/// Something that a line crosses.
struct Surface {
  SubPatchFinder::Walk walk;
  std::uint32_t sub_patch = kNone;  // kNone: an area light's
  std::uint32_t pane = kNone;
  bool walks = false, light = false;
};

static_assert(sizeof(Surface) == 40);  // as src/memory_plan.cpp tells

class Gather {
 public:
  Gather(const Scene& scene, const Geometry& geometry, const DirectLight& direct, Memory& memory)
      : scene_(scene), geometry_(geometry), direct_(direct), memory_(memory) {}

  void start();
  /// Errors: kMemory, kInterrupted.
  Status shoot(std::uint32_t lines, const Progress& progress, Arena& arena, Arena& for_cuts, Statistics& statistics);
  /// With an intersector that has started.
  void finish(Intersector& intersector);

 private:
  void bundle(std::uint32_t number, std::uint32_t count, double spacing);
  template <std::uint32_t kChannels>
  void follow_lines();
  void begin(std::uint32_t number);
  std::uint32_t look(std::uint32_t number, std::uint32_t further);
  template <std::uint32_t kChannels>
  void send(std::uint32_t from, std::uint32_t to, std::uint32_t number, std::uint32_t further);
  template <std::uint32_t kChannels>
  void sent_by(std::uint32_t from, std::uint32_t number, std::uint32_t further, std::uint32_t (&units)[3]);
  template <std::uint32_t kChannels>
  void send_unevenly(std::uint32_t from, std::uint32_t to, std::uint32_t number, std::uint32_t further);
  template <std::uint32_t kChannels>
  void exchange(std::uint32_t one, std::uint32_t other);
  void receive_nothing(std::uint32_t number, bool back);
  template <std::uint32_t kChannels>
  void through_panes(std::span<const std::uint32_t> order);
  template <std::uint32_t kChannels>
  void receive_through_panes(std::uint32_t k, std::span<const std::uint32_t> order, std::uint32_t line);
  void send_anew();
  double spacing_of(double lines) const;
  template <class Do>
  void for_started(Do act);

  const Scene& scene_;
  const Geometry& geometry_;
  const DirectLight& direct_;
  Memory& memory_;
  LineBundle lines_;
  std::span<Surface> surfaces_;
  std::uint64_t pieces_ = 0;
};

/// act(mesh's number, sub-patch counted from the mesh's first).
template <class Do>
void Gather::for_started(Do act) {
  for (std::uint32_t m = 0; m < scene_.meshes.size(); ++m) {
    const Mesh& mesh = scene_.meshes[m];
    for (std::uint32_t k = 0; k < mesh.sub_patch_count(); ++k) {
      if (memory_.sums.started(mesh.first_sub_patch + k)) act(m, k);
    }
  }
}

void Gather::start() {
  for (const Mesh& mesh : scene_.meshes) {
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) {
      if (!(direct_.visible_area[mesh.first_patch + p] > 0)) continue;
      SubPatchesOfPatch parts(mesh, p);
      for (std::uint32_t k = parts.next(); k != kNone; k = parts.next()) {
        const std::uint32_t number = mesh.first_sub_patch + k;
        if (!direct_.hidden.empty() && direct_.hidden[number] != 0) continue;
        memory_.sums.start(number, kPriorLines, memory_.sent.unit());
      }
    }
  }
}

/// A crossing that doesn't follow from the line before.
void Gather::begin(std::uint32_t number) {
  LineBundle::Crossing& crossing = lines_.crossing(number);
  Surface& surface = surfaces_[number];
  crossing.fresh = false;
  if (!crossing.first) {
    if (surface.walks) memory_.finder.go_on(crossing.triangle, lines_.point(crossing), surface.walk);
    return;
  }
  crossing.first = false;
  surface.light = !memory_.finder.is_of_mesh(crossing.triangle);
  surface.walks = !surface.light && memory_.finder.start(crossing.triangle, lines_.point(crossing),
                                                         lines_.way(crossing), surface.walk);
  surface.pane = kNone;
  for (std::uint32_t p = 0; p < geometry_.panes.size(); ++p) {
    const Pane& pane = geometry_.panes[p];
    if (crossing.triangle - pane.first >= pane.count) continue;
    surface.pane = p;
    break;
  }
}

/// On which sub-patch a line crosses it, `further` on than the first; line after line. kNone: an area light.
inline std::uint32_t Gather::look(std::uint32_t number, std::uint32_t further) {
  Surface& surface = surfaces_[number];
  if (surface.walks) return surface.walk.next();
  if (surface.light) return kNone;
  const LineBundle::Crossing& crossing = lines_.crossing(number);
  const SubPatchFinder::Found found = memory_.finder.find(crossing.triangle, lines_.point(crossing, further));
  return scene_.meshes[found.mesh].first_sub_patch + found.sub_patch;
}

/// What a sub-patch sends along a line, from where that crosses it, `further` on than the first.
template <std::uint32_t kChannels>
void Gather::sent_by(std::uint32_t from, std::uint32_t number, std::uint32_t further, std::uint32_t (&units)[3]) {
  const std::uint16_t* const sent = memory_.sent.of<kChannels>(from);
  if (SentLight::is_uneven(sent)) {
    const LatticePoint at = lines_.point(lines_.crossing(number), further);
    return memory_.sent.from(sent, scene_point(geometry_.lattice, at), units);
  }
  for (std::uint32_t c = 0; c < kChannels; ++c) units[c] = SentLight::unpacked(sent[c]);
}

template <std::uint32_t kChannels>
[[gnu::noinline]] void Gather::send_unevenly(std::uint32_t from, std::uint32_t to, std::uint32_t number,
                                             std::uint32_t further) {
  std::uint32_t units[3];
  sent_by<kChannels>(from, number, further, units);
  memory_.sums.add<kChannels>(to, [&](std::uint32_t c) { return units[c]; });
}

/// A line brings it to another.
template <std::uint32_t kChannels>
inline void Gather::send(std::uint32_t from, std::uint32_t to, std::uint32_t number, std::uint32_t further) {
  if (to == kNone || !memory_.sums.count(to) || from == kNone) return;
  const std::uint16_t* const sent = memory_.sent.of<kChannels>(from);
  if (SentLight::is_uneven(sent)) return send_unevenly<kChannels>(from, to, number, further);
  memory_.sums.add<kChannels>(to, [&](std::uint32_t c) { return SentLight::unpacked(sent[c]); });
}

/// Two fronts face each other; what faces a light receives nothing along the line.
template <std::uint32_t kChannels>
void Gather::exchange(std::uint32_t one, std::uint32_t other) {
  const std::uint32_t lines = lines_.lines();
  for (std::uint32_t k = 0; k < lines; ++k) {
    const std::uint32_t a = look(one, k), b = look(other, k);
    send<kChannels>(a, b, one, k);
    send<kChannels>(b, a, other, k);
  }
}

/// A front sees a back, or nothing.
void Gather::receive_nothing(std::uint32_t number, bool back) {
  if (surfaces_[number].light) return;
  const std::uint32_t lines = lines_.lines();
  for (std::uint32_t k = 0; k < lines; ++k) {
    const std::uint32_t to = look(number, k);
    if (to != kNone && memory_.sums.count(to) && back) memory_.sums.count_back(to);
  }
}

/// What the front of the k-th surface gets along one line where panes may stand in between: they weaken what comes
/// through, and send what their fronts reflect.
template <std::uint32_t kChannels>
void Gather::receive_through_panes(std::uint32_t k, std::span<const std::uint32_t> order, std::uint32_t line) {
  const std::uint32_t to = surfaces_[order[k]].sub_patch;
  if (to == kNone || !memory_.sums.count(to)) return;
  const bool up = lines_.crossing(order[k]).up;
  double part[3] = {1, 1, 1};
  for (std::uint32_t next = up ? k + 1 : k - 1; next < order.size(); next += up ? 1u : 0u - 1u) {
    const Surface& other = surfaces_[order[next]];
    const bool front = lines_.crossing(order[next]).up != up;
    if (front && other.sub_patch != kNone) {
      std::uint32_t units[3];
      sent_by<kChannels>(other.sub_patch, order[next], line, units);
      memory_.sums.add<kChannels>(to, [&](std::uint32_t c) { return static_cast<std::uint32_t>(part[c] * units[c]); });
    }
    if (other.pane == kNone) {
      if (!front) memory_.sums.count_back(to);
      return;
    }
    for (std::uint32_t c = 0; c < kChannels; ++c) part[c] *= geometry_.panes[other.pane].transmit.c[c];
  }
}

template <std::uint32_t kChannels>
void Gather::through_panes(std::span<const std::uint32_t> order) {
  for (std::uint32_t line = 0; line < lines_.lines(); ++line) {
    for (const std::uint32_t number : order) surfaces_[number].sub_patch = look(number, line);
    for (std::uint32_t k = 0; k < order.size(); ++k) receive_through_panes<kChannels>(k, order, line);
  }
}

/// Lines that cross the same in the same order.
template <std::uint32_t kChannels>
void Gather::follow_lines() {
  const std::span<const std::uint32_t> order = lines_.order();
  const std::uint32_t count = static_cast<std::uint32_t>(order.size());
  pieces_ += std::uint64_t{count} * lines_.lines();
  for (const std::uint32_t number : order) {
    if (lines_.crossing(number).fresh) begin(number);
  }
  if (!geometry_.panes.empty()) return through_panes<kChannels>(order);
  for (std::uint32_t k = 0; k < count; ++k) {
    const bool up = lines_.crossing(order[k]).up, last = k + 1 == count;
    if (up && !last && !lines_.crossing(order[k + 1]).up) {
      exchange<kChannels>(order[k], order[k + 1]);
      ++k;
    } else {
      receive_nothing(order[k], up ? !last : k > 0);
    }
  }
}

/// Directions are Sobol's points (1967) in the unit square, its first side the height over the hemisphere: even by
/// area, those of the first bundles, too.
void Gather::bundle(std::uint32_t number, std::uint32_t count, double spacing) {
  std::uint32_t high = 0, around = 0, bit = 1u << 31, mixed = bit;
  for (std::uint32_t left = number; left != 0; left >>= 1, bit >>= 1, mixed ^= mixed >> 1) {
    if ((left & 1) == 0) continue;
    high ^= bit;
    around ^= mixed;
  }
  const double up = 0x1p-32 * high + 0.5 / count, along = square_root(up < 1 ? 1 - up * up : 0);
  const double turn = 360 * (0x1p-32 * around);
  const Vec3 direction{along * cosine_degrees(turn), along * sine_degrees(turn), up};
  lines_.aim(direction, spacing, fraction(0.5 + number * kShift), fraction(0.5 + number * kGolden * kShift));
  while (lines_.next_row()) {
    while (lines_.next_lines()) {
      if (scene_.channels == 1) {
        follow_lines<1>();
      } else {
        follow_lines<3>();
      }
    }
  }
}

/// What sub-patches send, from what they have gathered; not of those over which something may stand.
void Gather::send_anew() {
  std::uint32_t of_mesh = kNone;
  MeshReflectance reflectance;
  for_started([&](std::uint32_t m, std::uint32_t k) {
    const Mesh& mesh = scene_.meshes[m];
    const std::uint32_t number = mesh.first_sub_patch + k;
    if (memory_.sums.sees_backs(number)) return;
    if (m != of_mesh) reflectance = MeshReflectance(scene_, m);
    of_mesh = m;
    double lx[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < scene_.channels; ++c) lx[c] = memory_.sums.mean(number, c, memory_.sent.unit());
    memory_.sent.set(reflectance, mesh, k, lx);
  });
}

/// In steps of the lattice, so that a sub-patch has so many lines of a bundle: it turns half of its area to a bundle,
/// on average, whichever way that is. Where area lights are far larger than all else lines are further apart.
double Gather::spacing_of(double lines) const {
  double area = 0, crossed = 0;
  for (const Mesh& mesh : scene_.meshes) {
    for (std::uint32_t p = 0; p < mesh.patch_count(); ++p) area += length(patch_piece(scene_, mesh, p).vector_area());
  }
  for (const Triangle& triangle : geometry_.triangles) crossed += 0.5 * length(vector_of(triangle.n));
  const double steps = geometry_.lattice.steps_per_unit;
  const double spacing = steps * square_root(area / scene_.sub_patch_count / (2 * lines));
  const double least = square_root(crossed / kMostOfMeshes / scene_.sub_patch_count / (2 * lines));
  return spacing > least ? spacing : least;
}

Status Gather::shoot(std::uint32_t lines, const Progress& progress, Arena& arena, Arena& for_cuts,
                     Statistics& statistics) {
  const ArenaScratch release(arena);
  if (scene_.sub_patch_count == 0) return {};
  if (!lines_.take(geometry_, arena, for_cuts) ||
      !arena.take("surfaces along a line", lines_.polygons(), surfaces_)) {
    return arena.refused();
  }
  std::uint32_t count = 1;  // a power of two, nearest to so many
  while (static_cast<double>(count) * count * 2 <= kBundles * kBundles * lines) count *= 2;
  const double spacing = spacing_of(static_cast<double>(lines) / count);
  for (std::uint32_t k = 0; k < count; ++k) {
    if (!progress.go_on(Stage::kSolution, k, count)) return interrupted();
    for (std::uint32_t update = 1; update <= kUpdates; ++update) {
      if (k > 0 && k == count >> update) send_anew();
    }
    bundle(k, count, spacing);
  }
  statistics.segments_ambient += pieces_;
  statistics.tests_ambient += lines_.tests();
  return {};
}

/// Of a sub-patch that stands partly inside or under something the lines of the visible part count; if none is seen,
/// those that meet no back, so that it mostly keeps what it had.
void Gather::finish(Intersector& intersector) {
  for_started([&](std::uint32_t m, std::uint32_t k) {
    const std::uint32_t number = scene_.meshes[m].first_sub_patch + k;
    double over = 1;
    if (memory_.sums.sees_backs(number)) {
      const std::uint32_t visible = visible_sixteenths(scene_, geometry_, intersector, m, k);
      over = visible > 0 ? 16.0 / visible
                         : memory_.sums.lines(number) / static_cast<double>(memory_.sums.not_backs(number));
    }
    double lx[3] = {0, 0, 0};
    for (std::uint32_t c = 0; c < scene_.channels; ++c) {
      lx[c] = over * memory_.sums.mean(number, c, memory_.sent.unit());
    }
    memory_.sums.finish(number, lx);
  });
}

constexpr std::uint64_t block(std::uint64_t bytes) { return (bytes + 7) / 8 * 8; }

/// What it takes of the arena, and what of that may stand where patches' values do.
struct Bytes {
  std::uint64_t lines, cuts;  // counts of sub-patches' lines, what rows cut
  std::uint64_t all_along, while_shooting, at_the_end;

  Bytes(const Scene& scene, const Geometry& geometry, const Options& options, std::uint32_t near) {
    const GatheredSums::Bytes sums = GatheredSums::bytes(scene);
    const LineBundle::Bytes bundle = LineBundle::bytes(geometry);
    lines = sums.lines;
    cuts = bundle.cuts;
    all_along = SubPatchFinder::bytes(geometry) + SentLight::bytes(scene, near) + sums.rest;
    while_shooting = bundle.rest + block(sizeof(Surface) * std::uint64_t{bundle.polygons});
    at_the_end = Intersector::bytes(geometry, options.flags);
  }
  std::uint64_t with(bool lines_elsewhere, bool cuts_elsewhere) const {
    const std::uint64_t shooting = while_shooting + (cuts_elsewhere ? 0 : cuts);
    return all_along + (lines_elsewhere ? 0 : lines) + (shooting > at_the_end ? shooting : at_the_end);
  }
};

}  // namespace

Status gather_illuminance(const Scene& scene, const Geometry& geometry, const DirectLight& direct, std::uint32_t near,
                          Intersector& intersector, const Options& options, const Progress& progress, Arena& arena,
                          GatherRoom room, std::span<float> ambient_lx, Statistics& statistics) {
  const ArenaScratch release(arena);
  const Bytes bytes(scene, geometry, options, near);
  const bool tight = arena.left() < bytes.with(false, false);
  Arena of_ambient(room.ambient.data(), room.ambient.size_bytes());
  Arena of_direct(room.direct.data(), room.direct.size_bytes());
  Arena& for_lines = tight && bytes.lines <= of_ambient.capacity() ? of_ambient : arena;
  Arena& for_cuts = tight && bytes.cuts <= of_direct.capacity() ? of_direct : arena;
  Memory memory;
  if (!memory.finder.take(scene, geometry, arena) ||
      !memory.sent.take(scene, geometry.lattice.step(), near, direct, ambient_lx, arena) ||
      !memory.sums.take(scene, ambient_lx, arena, for_lines)) {
    return arena.refused();
  }
  const std::uint32_t asked = options.gather_lines > 0 ? options.gather_lines : kGatherLines;
  const std::uint32_t lines = asked < kMostGatherLines ? asked : kMostGatherLines;
  Gather gather(scene, geometry, direct, memory);
  gather.start();
  if (const Status status = gather.shoot(lines, progress, arena, for_cuts, statistics); !status.done()) return status;
  const IntersectorScratch seeking(intersector);
  if (!intersector.start(arena, Rectangles::kWhole)) return arena.refused();
  gather.finish(intersector);
  return {};
}

std::uint64_t gather_bytes(const Scene& scene, const Geometry& geometry, const Options& options, std::uint32_t near) {
  const Bytes bytes(scene, geometry, options, near);
  const std::uint64_t room = sizeof(double) * std::uint64_t{scene.patch_count} * scene.channels;
  return bytes.with(bytes.lines <= room, bytes.cuts <= room);
}

}  // namespace shodo
