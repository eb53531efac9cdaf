// Hard cases of pictures: 15, 18, 19, 20, 21, 22, 23, 24.
#include <cmath>

#include "hard/hard_case.h"
#include "hard/run.h"
#include "hard/scene_text.h"
#include "support/seen_row.h"
#include "visibility/scenes.h"

namespace shodo::hard {

namespace {

struct Seen {
  std::uint64_t samples = 0;
  std::uint64_t wrong = 0;  // other than the twin's
  std::uint64_t covered = 0;
  std::uint64_t of_mesh = 0;  // of the meshes asked for
};

/// Every `every`-th sample of a camera's picture against the 128-bit twin; meshes from `first_mesh` on are counted.
Seen against_twin(const FullRun& run, std::size_t camera, std::uint32_t width, std::uint32_t height,
                  std::uint32_t antialias, std::uint32_t every = 1, std::uint32_t first_mesh = kNone) {
  const Model& model = run.model();
  const SampleGrid grid = sample_grid(view_of(model.scene.cameras[camera], model.geometry.lattice, width, height),
                                      width, height, antialias);
  const PictureTwin twin(model.scene, model.geometry, grid);
  std::vector<std::uint64_t> memory(std::size_t{8} << 20);
  Arena arena(memory.data(), memory.size() * 8);
  VisibleLines lines;
  Seen result;
  if (!lines.start(model.scene, model.geometry, grid, arena)) return result;
  for (std::uint32_t y = 0; y < grid.rows; ++y) {
    const std::vector<TwinHit> seen = seen_row(lines, grid, y);
    for (std::uint32_t x = y % every; x < grid.columns; x += every) {
      ++result.samples;
      result.covered += seen[x].triangle != kNone ? 1 : 0;
      if (seen[x].triangle != kNone && model.geometry.drawn[seen[x].triangle].mesh != kNone) {
        result.of_mesh += model.geometry.drawn[seen[x].triangle].mesh >= first_mesh ? 1 : 0;
      }
      result.wrong += seen[x] == twin.hit(x, y) ? 0 : 1;
    }
  }
  return result;
}

}  // namespace

CaseResult edge_on_patch() {
  // The eye in the plane of three polygons; one of them holds the eye.
  Findings found;
  for (const double angle : {0.0, 0.1, 1.3}) {
    SceneText scene(turn({1, 2, 3}, angle));
    scene.material("white", 0.5);
    scene.object("room");
    scene.room({0, 0, 0}, {4, 3, 2}, 3, 2);
    scene.object("edge_on");
    scene.quad({1, 1, 1}, {3, 1, 1}, {3, 2, 1}, {1, 2, 1});
    scene.triangle({3.2, 0.5, 1}, {3.8, 1, 1}, {3.5, 2.5, 1});
    scene.quad({0.25, 0.25, 1}, {0.75, 0.25, 1}, {0.75, 0.75, 1}, {0.25, 0.75, 1});
    scene.point_light({1.3, 0.9, 1.6}, 100);
    scene.camera("eye", {0.5, 0.5, 1}, {3, 1.5, 1}, {0, 0, 1}, 80);
    scene.camera("aslant", {0.5, 0.5, 1}, {3, 1.5, 1.4}, {0.3, 0, 1}, 120);
    FullRun run(scene.text(), small_picture(200, 150));
    found.demand(run.done() && !run.picture().empty(), "a picture");
    for (std::uint32_t c = 0; c < 2; ++c) {
      const Seen seen = against_twin(run, c, 200, 150, 1, angle == 0 ? 1 : 3, 6);
      found.demand(seen.wrong == 0 && seen.covered == seen.samples, "the twin's pixels, all of them covered");
      // On the lattice the eye of a turned scene is up to a step off their planes: the one that holds it may fill the
      // picture's lower half then, as from a hair above it.
      if (angle != 0) continue;
      found.worst(static_cast<double>(seen.of_mesh));
      found.demand(seen.of_mesh == 0, say("no pixels of polygons seen edge on: %g", static_cast<double>(seen.of_mesh)));
    }
  }
  return found.result("pixels of three polygons in the plane of the eye");
}

CaseResult camera_on_surface() {
  Findings found;
  SceneText scene;
  scene.material("white", 0.5);
  scene.object("room");
  scene.room({0, 0, 0}, {4, 3, 2}, 3, 1);
  scene.object("closed");
  scene.box({1, 1, 0.5}, {2, 2, 1.5}, 2, 1);
  scene.point_light({3, 2.5, 1.6}, 300);
  scene.camera("on_floor", {0.5, 0.5, 0}, {3, 2, 0.5}, {0, 0, 1}, 80);
  scene.camera("on_edge", {0.5, 0, 0}, {3, 2, 0.5}, {0, 0, 1}, 80);
  scene.camera("in_corner", {0, 0, 0}, {3, 2, 0.5}, {0, 0, 1}, 80);
  scene.camera("on_box", {1.5, 1, 1}, {1.5, 3, 1}, {0, 0, 1}, 100);
  scene.camera("in_box", {1.5, 1.5, 1}, {1, 1, 0.5}, {0, 0, 1}, 100);
  scene.camera("outside", {-9, 7, 9}, {2, 1, 1}, {0, 0, 1}, 30);
  const std::string text = scene.text();
  std::uint64_t samples = 0;
  for (std::uint32_t c = 0; c < 6; ++c) {
    Options options = small_picture(100, 80);
    const char* names[] = {"on_floor", "on_edge", "in_corner", "on_box", "in_box", "outside"};
    options.camera = names[c];
    FullRun run(text, options);
    found.demand(run.done(), "a solution");
    const auto pixels = run.picture();
    found.demand(!pixels.empty(), "an image");
    const Seen seen = against_twin(run, c, 100, 80, 1);
    samples += seen.samples;
    found.worst(static_cast<double>(seen.wrong));
    found.demand(seen.wrong == 0, say("the twin's surfaces from %s", names[c]));
    std::size_t bright = 0;
    for (const std::uint8_t byte : pixels) bright += byte > 0 ? 1 : 0;
    // Inside the closed box there are backs all round: black, but every sample sees one.
    if (c == 4) found.demand(bright == 0 && seen.covered == seen.samples, "black backs from inside");
    // From on a wall the half of the picture that looks behind it sees nothing.
    if (c < 3) found.demand(bright > 0 && seen.covered * 3 > seen.samples, "the room from its floor");
  }
  return found.result(say("of %llu samples from a floor, an edge, a corner, inside a box differ from the 128-bit twin",
                          static_cast<unsigned long long>(samples)));
}

CaseResult near_plane_crossers() {
  Findings found;
  std::uint64_t samples = 0;
  Random random(4);
  for (int k = 0; k < (thorough() ? 60 : 6); ++k) {
    SceneText scene;
    scene.material("white", 0.5);
    scene.object("crossing");
    // Behind the eye to the horizon; corners at the eye's own plane, and all round it.
    scene.quad({-50, -40, -1}, {60, -45, -1}, {55, 50, -1}, {-45, 55, -1});
    for (int i = 0; i < 12; ++i) {
      const auto any = [&](double reach) { return reach * random.signed_unit(); };
      const Vec3 a{0, any(3), any(3)}, b{any(30), any(30), any(3)}, c{-any(30), any(30), any(3)};
      scene.triangle(a, b, c);
      scene.quad({-20, i - 6.0, 0.3}, {30, i - 6.0 + any(0.1), 0.3}, {30, i - 5.5, 0.3}, {-20, i - 5.5, 0.3});
    }
    scene.camera("eye", {0, 0, 0}, {1, 0, -0.02}, {0, 0, 1}, 30 + 20.0 * (k % 6));
    const FullRun run(scene.text(), small_picture());
    found.demand(run.done(), "a solution");
    const Seen seen = against_twin(run, 0, 90, 70, k % 2 == 0 ? 1 : 4);
    samples += seen.samples;
    found.worst(static_cast<double>(seen.wrong));
    found.demand(seen.wrong == 0 && seen.covered > 1000, "pixels of the 128-bit twin");
  }
  return found.result(say("of %llu samples differ from the 128-bit twin", static_cast<unsigned long long>(samples)));
}

CaseResult nonplanar_quad() {
  Findings found;
  SceneText scene;
  scene.material("white", 0.5);
  scene.object("sheet");
  // 4 x 4 saddles with common edges, and a dart with its other half.
  const auto at = [](int i, int j) { return Vec3{0.5 * i, 0.5 * j, ((i * 7 + j * 5) % 3) * 0.2}; };
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) scene.quad(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), 3, 2);
  }
  scene.object("dart");
  scene.quad({3, 0, 0}, {3.5, 0.6, 0}, {4, 0, 0}, {3.5, 2, 0}, 2, 2);  // the concave corner is the second
  scene.quad({3, 0, 0}, {3.5, -0.2, 0}, {4, 0, 0}, {3.5, 0.6, 0}, 2, 2);
  scene.point_light({2, 1, 4}, 300);
  scene.camera("above", {1.9, 1, 5}, {2, 1, 0}, {0, 1, 0}, 50);
  scene.camera("low", {2, -5, 1}, {2, 1, 0}, {0, 0, 1}, 40);
  const FullRun run(scene.text(), small_picture());
  found.demand(run.done() && run.sound(), "a solution");
  for (std::uint32_t c = 0; c < 2; ++c) {
    const Seen seen = against_twin(run, c, 150, 110, 1);
    found.worst(static_cast<double>(seen.wrong));
    found.demand(seen.wrong == 0 && seen.covered > 500, "pixels of the twin");
  }
  // No holes: from above, each sample well inside the sheet's outline sees it.
  const Model& model = run.model();
  const Intersector intersector(model.geometry);
  Random random(2);
  for (int k = 0; k < 20000; ++k) {
    const bool dart = k % 4 == 0;
    const Vec3 p = dart ? Vec3{3.45 + 0.1 * random.unit(), 0.05 + 1.5 * random.unit(), 0}
                        : Vec3{0.01 + 1.98 * random.unit(), 0.01 + 1.98 * random.unit(), 0};
    const LatticePoint above = odd_point(model.geometry.lattice, p + Vec3{0, 0, 3} - model.scene.origin);
    const LatticePoint below = odd_point(model.geometry.lattice, p - Vec3{0, 0, 0.7} - model.scene.origin);
    Intersector one(model.geometry);
    found.demand(one.blocked(above, below, {}), say("no holes: %g %g", p.x, p.y));
  }
  // The dart's area is its own, whichever corner comes first.
  double area = 0;
  for (std::uint32_t k = 0; k < 4; ++k) area += model.patches[run.mesh(16).first_patch + k].area;
  found.demand(relative(area, 0.7) < 1e-12, say("the dart's area: %g", area));
  const FullRun bow("shodo 1\nmaterial white diffuse 0.5\nobject o\nquad white 0 0 0  1 1 0  1 0 0  0 1 0\n");
  found.demand(bow.status.code == StatusCode::kScene && bow.status.line == 4, "a bow-tie refused with its line");
  return found.result(
      "samples of saddles and a concave quad that differ from the twin; no holes; a bow-tie is refused with "
      "its line");
}

CaseResult huge_polygon() {
  // A ground of ten thousand rooms' size under a room; seen from far above it covers the picture, once.
  Findings found;
  for (const double size : {1e2, 1e3, 1e4}) {
    SceneText scene;
    scene.material("white", 0.5);
    scene.object("ground");
    scene.quad({-3 * size, -3 * size, -1}, {3 * size, -3 * size, -1}, {3 * size, 3 * size, -1},
               {-3 * size, 3 * size, -1}, 4, 4, 1);
    scene.object("room");
    scene.room({0, 0, 0}, {6, 4, 3}, 2, 1);
    scene.point_light({2, 2, 2}, 100);
    scene.sun({0.1, 0.2, -1}, 1000);
    scene.camera("above", {0, 0, 2 * size}, {1, 0, -1}, {0, 1, 0}, 90);
    scene.camera("inside", {1, 1, 1}, {6, 4, 1.5}, {0, 0, 1}, 90);
    const FullRun run(scene.text(), small_picture());
    found.demand(run.done() && run.sound(), say("a solution at %g", size));
    const Seen above = against_twin(run, 0, 90, 70, 1), inside = against_twin(run, 1, 90, 70, 1);
    found.worst(static_cast<double>(above.wrong + inside.wrong));
    found.demand(above.wrong + inside.wrong == 0, say("the twin's pixels at %g", size));
    found.demand(inside.covered == inside.samples, "a closed room from inside");
    // The ground once, on every sample that looks at it.
    const Model& model = run.model();
    const SampleGrid grid = sample_grid(view_of(model.scene.cameras[0], model.geometry.lattice, 90, 70), 90, 70, 1);
    const PictureTwin twin(model.scene, model.geometry, grid);
    for (std::uint32_t y = 0; y < 70; y += 3) {
      for (std::uint32_t x = 0; x < 90; x += 3) {
        const TwinHit hit = twin.hit(x, y);
        if (hit.triangle < 2) found.demand(twin.cover(x, y) == 1, "every pixel covered once");
      }
    }
    // What is too fine for the lattice then is counted; the closed room's light stays within it, or is dropped.
    const Statistics& counted = model.statistics;
    found.demand(counted.lattice_step <= 6 * size / 5e5 * 2, "the step that the size allows");
    found.demand(counted.patches + counted.patches_dropped == 16 + 24, "dropped patches counted");
    double flux = 0;
    for (std::uint32_t i = 16; i < run.patches(); ++i) flux += model.patches[i].area * run.e0(i);
    const double of_sun = 6 * 4 * 1000 / std::sqrt(1.05);
    found.demand(counted.patches_dropped > 0 || (flux > 0.97 * 400 * M_PI && flux < 1.03 * (400 * M_PI + of_sun)),
                 say("the room's own light at %g: %g", size, flux));
  }
  return found.result("pixels that differ from the twin with a polygon of 1e4 rooms' size; every pixel covered once");
}

CaseResult subpixel_polygons() {
  // 320 x 320 quads of 2^-9 in one sheet, far below a pixel each: the picture is that of one quad.
  Findings found;
  const int cells = thorough() ? 320 : 128;
  const auto make = [&](bool cut) {
    const double size = 1.0 / 256, half = cells / 2 * size;
    std::string text = "shodo 1\nmaterial white diffuse 0.5\nobject sheet\n";
    if (cut) {
      const std::string side = std::to_string(cells + 1);
      text += "grid white " + side + " " + side;
      for (int j = 0; j <= cells; ++j) {
        for (int i = 0; i <= cells; ++i) text += " " + number(i * size - half) + " " + number(half - j * size) + " 0";
        text += j % 8 == 7 ? " " : "";
      }
      text += "\n";
    } else {
      const std::string l = number(-half), h = number(half);
      text += "quad white " + l + " " + l + " 0 " + h + " " + l + " 0 " + h + " " + h + " 0 " + l + " " + h +
              " 0 patches 1 1\n";
    }
    return text +
           "sub sheet 1 1\nlight l sun towards 0 0 -1 illuminance 1000\n"
           "camera eye eye 0.01 0.02 4 look 0 0 0 up 0.1 1 0 fov 60\n";
  };
  Options options = small_picture(40, 30);
  options.rules.blocks = true;
  FullRun fine(make(true), options), whole(make(false), options);
  found.demand(fine.done() && whole.done(), say("a solution: %s", fine.status.message));
  const auto seen = fine.picture(), expected = whole.picture();
  found.demand(!seen.empty() && seen == expected, "the picture of one quad");
  const Model& model = fine.model();
  const SampleGrid grid = sample_grid(view_of(model.scene.cameras[0], model.geometry.lattice, 40, 30), 40, 30, 1);
  const PictureTwin twin(model.scene, model.geometry, grid);
  std::uint32_t covered = 0;
  for (std::uint32_t y = 0; y < 30; y += 5) {
    for (std::uint32_t x = 0; x < 40; x += 5) {
      const std::uint32_t count = twin.cover(x, y);
      found.demand(count <= 1, "each pixel covered once");
      covered += count;
    }
  }
  found.worst(cells * cells);
  found.demand(covered > 0, "covered pixels");
  return found.result(
      "quads in a sheet, each far below a pixel: each sample covered exactly once, the picture of one quad");
}

CaseResult coords_65k() {
  // Triangles a hair from the eye: their corners project to 65,535, 2^31 and more pixels from the middle.
  Findings found;
  std::uint64_t samples = 0;
  Random random(9);
  for (const double depth : {1e-2, 1e-4, 4e-6, 2e-6}) {
    for (int k = 0; k < (thorough() ? 20 : 2); ++k) {
      SceneText scene;
      scene.material("white", 0.5);
      scene.object("near");
      for (int i = 0; i < 30; ++i) {
        const auto any = [&] { return random.signed_unit(); };
        const double d = i % 3 == 0 ? -depth : depth;
        scene.triangle({any(), any(), d}, {any(), any(), -depth}, {any(), any(), i % 2 == 0 ? depth : -1 - any()});
      }
      scene.quad({-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1});
      scene.camera("eye", {0, 0, 0}, {0.1 * random.signed_unit(), 0, -1}, {0, 1, 0}, k % 2 == 0 ? 60 : 2);
      const FullRun run(scene.text(), small_picture());
      found.demand(run.done(), "a solution");
      const Seen seen = against_twin(run, 0, 80, 60, 1);
      samples += seen.samples;
      found.worst(static_cast<double>(seen.wrong));
      found.demand(seen.wrong == 0, say("pixels of the 128-bit twin at %g", depth));
    }
  }
  return found.result(say("of %llu samples differ from the 128-bit twin, corners projecting to 2^31 pixels and beyond",
                          static_cast<unsigned long long>(samples)));
}

CaseResult shared_edge_sheet() {
  // A square of 1000 random triangles, corners on pixel centres among them: 0.5 x 0.5 pixels are 1/64.
  Findings found;
  std::uint64_t inside = 0;
  for (int round = 0; round < (thorough() ? 10 : 2); ++round) {
    Random random(20 + static_cast<std::uint64_t>(round));
    struct Three {
      LatticePoint p[3];
    };
    std::vector<Three> sheet{{{{-64, -64, 0}, {64, -64, 0}, {64, 64, 0}}},
                             {{{-64, -64, 0}, {64, 64, 0}, {-64, 64, 0}}}};
    const auto twice_area = [](const LatticePoint& a, const LatticePoint& b, const LatticePoint& c) {
      return cross(b - a, c - a).z;
    };
    while (sheet.size() < 1000) {
      const LatticePoint p{random.between(-64, 64), random.between(-64, 64), 0};
      std::vector<Three> next;
      for (const Three& t : sheet) {
        const bool holds = twice_area(t.p[0], t.p[1], p) >= 0 && twice_area(t.p[1], t.p[2], p) >= 0 &&
                           twice_area(t.p[2], t.p[0], p) >= 0;
        if (!holds || p == t.p[0] || p == t.p[1] || p == t.p[2]) {
          next.push_back(t);
          continue;
        }
        for (int k = 0; k < 3; ++k) {
          if (twice_area(t.p[k], t.p[(k + 1) % 3], p) > 0) next.push_back({{t.p[k], t.p[(k + 1) % 3], p}});
        }
      }
      sheet = next;
    }
    SceneText scene;
    scene.material("white", 0);
    scene.object("sheet");
    const auto at = [](const LatticePoint& p) { return Vec3{p.x / 64.0, p.y / 64.0, 0}; };
    for (const Three& t : sheet) scene.triangle(at(t.p[0]), at(t.p[1]), at(t.p[2]));
    scene.camera("eye", {0, 0, round % 2 == 0 ? 2.0 : -2.0}, {0, 0, 0}, {0, 1, 0}, 45);
    const FullRun run(scene.text(), small_picture());
    found.demand(run.done(), "a solution");
    const Model& model = run.model();
    const Seen seen = against_twin(run, 0, 64, 64, 1);
    found.demand(seen.wrong == 0, "the twin's pixels");
    const SampleGrid grid = sample_grid(view_of(model.scene.cameras[0], model.geometry.lattice, 64, 64), 64, 64, 1);
    const PictureTwin twin(model.scene, model.geometry, grid);
    // At 45 degrees a height of 2 is 1.66 across: all samples look at the square.
    for (std::uint32_t y = 0; y < 64; ++y) {
      for (std::uint32_t x = 0; x < 64; ++x) {
        const std::uint32_t count = twin.cover(x, y);
        ++inside;
        found.worst(count == 1 ? 0 : 1);
        found.demand(count == 1, say("a hit count of 1: %u", count));
      }
    }
    found.demand(seen.covered == std::uint64_t{64} * 64, "no gap");
  }
  return found.result(say("of %llu samples on sheets of 1000 triangles are hit other than once",
                          static_cast<unsigned long long>(inside)));
}

}  // namespace shodo::hard
