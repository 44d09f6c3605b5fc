#include "sim/render/figure_batches.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

const Capsule* FindFirst(const std::vector<Capsule>& shape, Part part) {
  for (const Capsule& capsule : shape) {
    if (capsule.part == part) return &capsule;
  }
  return nullptr;
}

// The roundest part of the head: a neck may be labelled kHead too, but gets no face.
const Capsule* FindSkull(const std::vector<Capsule>& shape) {
  const Capsule* skull = nullptr;
  for (const Capsule& capsule : shape) {
    if (capsule.part == Part::kHead && (!skull || capsule.radius > skull->radius)) skull = &capsule;
  }
  return skull;
}

// Which capsule gets a face, and where that looks.
struct Face {
  const Capsule* head = nullptr;  // null: no face
  glm::dvec3 up{0};
  glm::dvec3 front{0};
};

// The face looks where the chest does: across the shoulders × up the neck.
Face PlaceFace(const std::vector<Capsule>& shape) {
  const Capsule* left = FindFirst(shape, Part::kLeftUpperArm);
  const Capsule* right = FindFirst(shape, Part::kRightUpperArm);
  const Capsule* head = FindSkull(shape);
  if (!left || !right || !head) return {};
  const glm::dvec3 up = 0.5 * (head->a + head->b) - 0.5 * (left->a + right->a);
  const glm::dvec3 front = glm::cross(left->a - right->a, up);
  const double length = glm::length(front);
  if (!(length > 1e-9)) return {};
  return {head, up, front / length};
}

bool IsFinite(const glm::dvec3& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z);
}

void AddInstances(const Figure& figure, const glm::dvec3& eye, std::vector<CapsuleInstance>& instances) {
  const Face face = figure.is_hooded ? Face{} : PlaceFace(figure.shape);
  for (const Capsule& capsule : figure.shape) {
    if (!IsFinite(capsule.a) || !IsFinite(capsule.b) || !(capsule.radius > 0)) continue;
    const Rgb8 paint = figure.colours[static_cast<std::size_t>(capsule.part)];
    const auto label = static_cast<std::uint32_t>(figure.seen_as.value_or(capsule.part));
    const bool has_face = &capsule == face.head;
    const bool given_downwards = has_face && glm::dot(capsule.b - capsule.a, face.up) < 0;
    const glm::dvec3& start = given_downwards ? capsule.b : capsule.a;
    const glm::dvec3& end = given_downwards ? capsule.a : capsule.b;
    instances.push_back({glm::vec4(start - eye, capsule.radius), glm::vec4(end - eye, label),
                         glm::vec4(paint.r, paint.g, paint.b, has_face ? 255 : 0) / 255.0f, glm::vec3(face.front)});
  }
}

// Metres. Well inside what a float's products hold; NaN is not inside either.
constexpr float kFarthestCorner = 1e6f;

bool IsWithin(const glm::vec3& v, float limit) {
  return std::abs(v.x) < limit && std::abs(v.y) < limit && std::abs(v.z) < limit;
}

bool IsDrawable(const SurfaceCorner& corner) {
  return IsWithin(corner.place, kFarthestCorner) && IsWithin(corner.normal, 2);
}

glm::vec3 ColourOf(const Surface& surface, Part part) {
  const Rgb8 colour = surface.by_part ? (*surface.by_part)[static_cast<std::size_t>(part)] : surface.colour;
  return glm::vec3(colour.r, colour.g, colour.b) / 255.0f;
}

void AddCorners(const Surface& surface, std::optional<Part> seen_as, int paint, const glm::dvec3& eye,
                std::vector<SurfaceCorner>& corners) {
  assert(surface.normals.size() == surface.positions.size() && surface.parts.size() == surface.triangles.size());
  assert(!surface.paint || surface.rest.size() == surface.positions.size());
  assert(surface.paint || !surface.texture || surface.on_texture.size() == surface.positions.size());
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const glm::vec4 paint_and_label(ColourOf(surface, surface.parts[i]),
                                    static_cast<std::uint32_t>(seen_as.value_or(surface.parts[i])));
    std::array<SurfaceCorner, 3> triangle{};
    std::ranges::transform(surface.triangles[i], triangle.begin(), [&](std::uint32_t vertex) {
      const glm::vec3 rest = surface.paint     ? surface.rest[vertex]
                             : surface.texture ? glm::vec3(surface.on_texture[vertex], 0)
                                               : glm::vec3(0);
      return SurfaceCorner{glm::vec3(surface.positions[vertex] - eye), glm::vec3(surface.normals[vertex]),
                           paint_and_label, glm::vec4(rest, paint)};
    });
    if (std::ranges::all_of(triangle, IsDrawable)) corners.insert(corners.end(), triangle.begin(), triangle.end());
  }
}

}  // namespace

std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye) {
  std::vector<CapsuleInstance> instances;
  for (const Figure& figure : figures) AddInstances(figure, eye, instances);
  return instances;
}

void MakeCorners(const std::vector<Figure>& figures, const glm::dvec3& eye, SurfaceCorners& corners) {
  corners.plain.clear();
  corners.painted.clear();
  corners.textured.clear();
  corners.textures.clear();
  int paints = 0;
  for (const Figure& figure : figures) {
    for (const Surface& surface : figure.surfaces) {
      if (surface.paint) {
        AddCorners(surface, figure.seen_as, paints++, eye, corners.painted);
      } else if (surface.texture) {
        const std::size_t first = corners.textured.size();
        AddCorners(surface, figure.seen_as, -1, eye, corners.textured);
        corners.textures.push_back({surface.texture, first, corners.textured.size() - first});
      } else {
        AddCorners(surface, figure.seen_as, -1, eye, corners.plain);
      }
    }
  }
}

std::vector<SurfacePaint> PaintsOf(const std::vector<Figure>& figures) {
  std::vector<SurfacePaint> paints;
  for (const Figure& figure : figures) {
    for (const Surface& surface : figure.surfaces) {
      if (surface.paint) paints.push_back(*surface.paint);
    }
  }
  return paints;
}

}  // namespace etude
