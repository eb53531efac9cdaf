#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "hard/hard_case.h"

namespace shodo::hard {

namespace {

constexpr HardCase kCases[] = {
    {1, "rho_to_1", rho_to_1},
    {2, "rho_exactly_1", rho_exactly_1},
    {3, "sliver_1e4", sliver_1e4},
    {4, "t_junction", t_junction},
    {5, "coplanar_overlap", coplanar_overlap},
    {6, "coplanar_identical", coplanar_identical},
    {7, "interpenetrating_boxes", interpenetrating_boxes},
    {8, "far_origin_1e6", far_origin},
    {9, "scale_1e-4 / scale_1e5", scaled},
    {10, "zero_area", zero_area},
    {11, "duplicate_vertices", duplicate_vertices},
    {12, "light_on_surface", light_on_surface},
    {13, "light_in_plane", light_in_plane},
    {14, "light_on_sample", light_on_sample},
    {15, "edge_on_patch", edge_on_patch},
    {16, "leaky_corner", leaky_corner},
    {17, "thin_wall", thin_wall},
    {18, "camera_on_surface / camera_inside_object", camera_on_surface},
    {19, "near_plane_crossers", near_plane_crossers},
    {20, "nonplanar_quad", nonplanar_quad},
    {21, "huge_polygon", huge_polygon},
    {22, "subpixel_polygons", subpixel_polygons},
    {23, "coords_65k", coords_65k},
    {24, "shared_edge_sheet", shared_edge_sheet},
    {25, "bad_numbers", bad_numbers},
    {26, "zero_lights", zero_lights},
    {27, "all_black / all_white", all_black_all_white},
    {28, "disconnected", disconnected},
    {29, "one_patch", one_patch},
    {30, "patches_1e5", patches_1e5},
    {31, "mirror_symmetry", mirror_symmetry},
    {32, "permuted_input", permuted_input},
    {33, "close_plates", close_plates},
    {34, "long_corridor", long_corridor},
    {35, "window_grid", window_grid},
};

}  // namespace

std::span<const HardCase> hard_cases() { return kCases; }

bool thorough() {
  const char* const asked = std::getenv("SHODO_HARD");
  return asked != nullptr && std::strcmp(asked, "all") == 0;
}

std::string say(const char* format, ...) {
  char text[512];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  return text;
}

}  // namespace shodo::hard
