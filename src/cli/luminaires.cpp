#include "cli/luminaires.h"

#include <cstdio>

namespace shodo {

namespace {

bool named_before(const Scene& scene, std::size_t k) {
  for (std::size_t other = 0; other < k; ++other) {
    if (scene.luminaires[other].path == scene.luminaires[k].path) return true;
  }
  return false;
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.5g", value);
  return text;
}

}  // namespace

std::vector<std::string> luminaire_lines(const Scene& scene) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    const Luminaire& luminaire = scene.luminaires[k];
    if (named_before(scene, k)) continue;
    lines.push_back(std::string(luminaire.path) + ": " + short_number(luminaire.lumens) + " lm, up to " +
                    short_number(scene.lights[luminaire.light].strength) + " cd, " +
                    std::to_string(luminaire.vertical.size()) + " x " + std::to_string(luminaire.horizontal.size()) +
                    " angles");
  }
  return lines;
}

std::vector<std::string> luminaire_warnings(const Scene& scene) {
  std::vector<std::string> lines;
  for (std::size_t k = 0; k < scene.luminaires.size(); ++k) {
    const Luminaire& luminaire = scene.luminaires[k];
    if (named_before(scene, k)) continue;
    const std::string path(luminaire.path);
    if (luminaire.tilted) lines.push_back("the TILT in " + path + " isn't applied");
    if (luminaire.poles_differ) {
      lines.push_back("the planes of " + path + " differ by more than 1 % along its axis: their mean counts");
    }
  }
  return lines;
}

}  // namespace shodo
