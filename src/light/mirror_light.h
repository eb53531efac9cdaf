// The first bounce of light over mirrors (--mirror-light on; doc/optics.md): what a source sends to a surface by way of
// a mirror, as if its image shone through the mirror's triangle.
//
// For a sample X, a mirror's triangle and a point S of a light, both in front of it, the image S' of S in the
// triangle's plane sends E = reflect I cos / |X - S'|^2 (of area and polyhedral lights 8 and 4 points a face, of suns
// the mirrored direction), if the way from X towards S' passes the triangle and neither leg, X to the mirror nor mirror
// to S, is blocked; panes weaken both. A sub-patch takes the mean over 4 x 4 samples. Facets of curved mirrors do the
// same each for itself.
// Exact: whether the rounded way passes the triangle (a seam counts once), and both legs. Approximate: the way is
// rounded to 2^-21, the mirror's point to two lattice steps; 16 samples; points instead of an integral, so a light much
// nearer than its own size is known to some percent only. Light that mirrors send on after a diffuse surface, and from
// mirror to mirror, is left out.
// Bytes: 48 a mirror's triangle; none without the option or without mirrors.
#pragma once

#include <cstdint>
#include <span>

#include "base/arena.h"
#include "light/receiver.h"
#include "light/sources.h"
#include "scene/mesh.h"

namespace shodo {

class MirrorLight {
 public:
  explicit MirrorLight(Sources& sources) : sources_(&sources) {}

  bool take(Arena& arena);
  static std::uint64_t bytes(const Scene& scene, const Geometry& geometry);
  bool any() const { return !mirrors_.empty(); }

  /// Adds to the mean illuminance of a sub-patch, lux by channel.
  void add(const Receiver& receiver, const Piece& piece, bool thin, double (&lux)[3]);

 private:
  struct Mirror {
    Vec3 normal;       // unit
    double plane = 0;  // normal . corner
    std::uint32_t triangle = 0, mesh = 0, cell = 0, optics = 0;

    double height(const Vec3& p) const { return dot(normal, p) - plane; }
    Vec3 turned(const Vec3& way) const { return way - (2 * dot(normal, way)) * normal; }
  };
  struct Way;

  void add_sample(const Receiver& receiver, const Sample& sample, const Mirror& mirror, double weight,
                  double (&lux)[3]);
  void add_way(const Receiver& receiver, const Sample& sample, const Mirror& mirror, const Way& way, double (&lux)[3]);

  Sources* sources_;
  std::span<Mirror> mirrors_;
};

}  // namespace shodo
