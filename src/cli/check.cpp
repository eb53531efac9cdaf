// check: reads everything, lights nothing, and says what would be modelled.
#include <cstdio>
#include <string>

#include "cli/commands.h"
#include "cli/luminaires.h"
#include "cli/output.h"
#include "cli/overlaps.h"
#include "cli/png.h"
#include "cli/run.h"
#include "memory_plan.h"

namespace shodo {

namespace {

/// 1526 as "1,526".
std::string grouped(std::uint64_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3; at -= 3) text.insert(at - 3, 1, ',');
  return text;
}

std::string count(std::uint64_t number, const std::string& one, const std::string& many) {
  return grouped(number) + " " + (number == 1 ? one : many);
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

std::string lights_text(const Scene& scene) {
  std::uint64_t kinds[5] = {};
  for (const Light& light : scene.lights) ++kinds[light.open ? 4 : static_cast<std::size_t>(light.kind)];
  const char* const names[5][2] = {
      {"point", "points"}, {"area", "areas"}, {"polyhedron", "polyhedra"}, {"sun", "suns"}, {"opening", "openings"}};
  std::string text;
  for (std::size_t k = 0; k < 5; ++k) {
    if (kinds[k] != 0) text += (text.empty() ? "" : ", ") + count(kinds[k], names[k][0], names[k][1]);
  }
  return text.empty() ? "none: everything will be black" : text;
}

std::string cameras_text(const Scene& scene) {
  std::string text;
  for (const Camera& camera : scene.cameras) text += (text.empty() ? "" : ", ") + std::string(camera.name);
  return text.empty() ? "none: there are maps, but no picture" : text;
}

std::string model_text(const Model& model) {
  const Statistics& s = model.statistics;
  std::string text =
      "channels:  " + std::string(s.channels == 1 ? "1, everything is grey" : "3, red green blue") + "\n";
  text += "model:     " + count(s.objects, "object", "objects") + ", " + count(s.meshes, "mesh", "meshes") + ", ";
  text += count(s.patches, "patch", "patches") + ", " + count(s.sub_patches, "sub-patch", "sub-patches") + "\n";
  if (s.planes != 0) {
    text += "planes:    " + count(s.planes, "measures", "measure") + ", besides; ";
    text += count(s.plane_sub_patches, "sub-patch", "sub-patches") + "\n";
  }
  text += "lights:    " + lights_text(model.scene) + "\n";
  for (const std::string& line : luminaire_lines(model.scene)) text += "           " + line + "\n";
  text += "cameras:   " + cameras_text(model.scene) + "\n";
  const double metres = s.lattice_step * model.scene.metres_per_unit;
  text += "lattice:   a step is " + short_number(s.lattice_step) + " scene units, " + short_number(1e6 * metres) +
          " micrometres; ";
  text += count(s.vertices_inserted, "vertex", "vertices") + " inserted, " + grouped(s.vertices_moved) + " moved\n";
  text += "dropped:   " + count(s.polygons_dropped, "polygon", "polygons") + " without area, ";
  text += count(s.patches_dropped, "patch", "patches") + " under 4 steps wide\n";
  return text;
}

std::string right(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

/// One line a part: bytes, the stages that hold it, name, formula.
std::string plan_text(const MemoryPlan& plan) {
  std::string text = "           of which, with n patches, s sub-patches and c channels:\n";
  for (std::size_t p = 0; p < plan.parts; ++p) {
    const PlannedPart& part = plan.part[p];
    std::string stages;
    for (std::size_t k = 0; k < kPlanStages; ++k) {
      stages += plan.stage[k] != 0 && part.in(k) ? static_cast<char>('1' + k) : ' ';
    }
    text += "           " + right(grouped(part.bytes), 11) + "  " + stages + "  ";
    const PartText what = plan_part_text(part.part);
    text += what.name + std::string(": ") + what.formula + "\n";
  }
  return text;
}

std::string memory_text(const Model& model, const Options& options, std::uint64_t budget) {
  const bool draws = !model.scene.cameras.empty();
  const MemoryPlan plan = plan_memory(model, draws);
  std::string text = "memory:    " + count(plan.peak(), "byte", "bytes") + " are the smallest budget that works";
  text += plan.peak() > budget ? "; --memory " + size_text(budget) + " is too small\n" : "\n";
  for (std::size_t k = 0; k < kPlanStages; ++k) {
    if (plan.stage[k] == 0) continue;
    text += "           " + right(grouped(plan.stage[k]), 11) + " in stage " + std::to_string(k + 1) + ", ";
    text += plan_stage_name(static_cast<PlanStage>(k)) + std::string("\n");
  }
  text += plan_text(plan);
  if (draws) {
    text += "           a PNG of " + std::to_string(options.width) + " x " + std::to_string(options.height) +
            " takes up to ";
    text += grouped(png_bytes(options.width, options.height)) + " besides; a PPM nothing\n";
  }
  return text;
}

std::string warnings_text(const Model& model) {
  const Statistics& s = model.statistics;
  std::string text;
  for (const std::string& line : luminaire_warnings(model.scene)) text += "warning:   " + line + "\n";
  if (std::uint64_t{100} * s.patches_thin > model.scene.patch_count) {
    text += "warning:   " + count(s.patches_thin, "patch is", "patches are") +
            " under 32 lattice steps wide, more than 1 % of them\n";
  }
  if (const std::uint64_t pairs = coplanar_overlaps(model); pairs != 0) {
    text += "warning:   " + count(pairs, "pair", "pairs") +
            " of polygons in one plane overlap: they receive and send light twice\n";
  }
  if (const std::uint64_t pairs = merged_plates(model); pairs != 0) {
    text += "warning:   " + count(pairs, "pair", "pairs") +
            " of polygons that face each other, nearer than two lattice steps, exchange no light\n";
  }
  return text;
}

}  // namespace

int check(const Arguments& arguments) {
  Run run(arguments);
  if (const int status = run.load_at_any_size(); status != 0) return status;
  if (!arguments.options.camera.empty()) {
    if (const int status = run.find_camera(); status != 0) return status;
  }
  std::string text = "scene:     " + arguments.scene + "\n" + model_text(run.model());
  text += memory_text(run.model(), arguments.options, arguments.memory);
  if (!arguments.quiet) text += warnings_text(run.model());
  FileError error;
  OutputFile out("-");
  return out.open(error) && out.write(text, error) && out.close(error) ? 0 : run.tell(error);
}

}  // namespace shodo
