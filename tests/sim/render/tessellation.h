#pragma once

#include <cmath>
#include <numbers>

#include "sim/render/scene.h"

namespace etude {

/// Returns a capsule's skin as triangles, with `around` corners (a multiple of 4) on each of its 2 · (around / 4 + 1)
/// circles, poles included. All corners lie on the skin, so triangles lie at most radius · (1 − cos²(π / around)) below
/// it.
inline Surface Tessellate(const Capsule& capsule, Rgb8 colour, int around) {
  const glm::dvec3 line = capsule.b - capsule.a;
  const glm::dvec3 along = glm::length(line) > 0 ? glm::normalize(line) : glm::dvec3(0, 1, 0);
  const glm::dvec3 hint = std::abs(along.y) < 0.7 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 across = glm::normalize(glm::cross(along, hint)), third = glm::cross(along, across);
  Surface surface{.colour = colour};
  const int quarter = around / 4;
  for (const int end : {0, 1}) {
    for (int ring = 0; ring <= quarter; ++ring) {
      const double latitude = std::numbers::pi / 2 * (end + static_cast<double>(ring) / quarter - 1);
      for (int i = 0; i < around; ++i) {
        const double turn = 2 * std::numbers::pi * i / around;
        const glm::dvec3 normal =
            std::sin(latitude) * along + std::cos(latitude) * (std::cos(turn) * across + std::sin(turn) * third);
        surface.positions.push_back((end == 0 ? capsule.a : capsule.b) + capsule.radius * normal);
        surface.normals.push_back(normal);
      }
    }
  }
  const auto corner = [around](int ring, int i) { return static_cast<std::uint32_t>(ring * around + i % around); };
  for (int ring = 0; ring <= 2 * quarter; ++ring) {
    for (int i = 0; i < around; ++i) {
      surface.triangles.push_back({corner(ring, i), corner(ring, i + 1), corner(ring + 1, i + 1)});
      surface.triangles.push_back({corner(ring, i), corner(ring + 1, i + 1), corner(ring + 1, i)});
    }
  }
  surface.parts.assign(surface.triangles.size(), capsule.part);
  return surface;
}

inline std::vector<Surface> Tessellate(const std::vector<Capsule>& shape, const PartColours& colours, int around) {
  std::vector<Surface> surfaces;
  for (const Capsule& capsule : shape) {
    surfaces.push_back(Tessellate(capsule, colours[static_cast<std::size_t>(capsule.part)], around));
  }
  return surfaces;
}

}  // namespace etude
