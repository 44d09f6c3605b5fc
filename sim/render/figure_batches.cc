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

// Returns the skull, the thickest capsule of the head. A neck may also be labelled kHead, but gets no face.
const Capsule* FindSkull(const std::vector<Capsule>& shape) {
  const Capsule* skull = nullptr;
  for (const Capsule& capsule : shape) {
    if (capsule.part == Part::kHead && (!skull || capsule.radius > skull->radius)) skull = &capsule;
  }
  return skull;
}

// The capsule on which a face is drawn, and the direction of the face.
struct Face {
  const Capsule* head = nullptr;  // the capsule of the head; null: no face
  glm::dvec3 up{0};
  glm::dvec3 front{0};
};

// Places the face in the direction of the chest: the cross product of the line across the shoulders and the line up the
// neck.
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

// The largest coordinate that is drawn, metres. Products of smaller floats do not overflow. NaN also fails the
// comparison.
constexpr float kMaxCoordinate = 1e6f;

bool IsWithin(const glm::vec3& v, float limit) {
  return std::abs(v.x) < limit && std::abs(v.y) < limit && std::abs(v.z) < limit;
}

bool IsDrawable(const SurfaceCorner& corner) {
  return IsWithin(corner.place, kMaxCoordinate) && IsWithin(corner.normal, 2);
}

glm::vec3 ColourOf(const Surface& surface, Part part) {
  const Rgb8 colour = surface.by_part ? (*surface.by_part)[static_cast<std::size_t>(part)] : surface.colour;
  return glm::vec3(colour.r, colour.g, colour.b) / 255.0f;
}

void AddTriangles(const Surface& surface, std::optional<Part> seen_as, int paint, const glm::dvec3& eye,
                  Triangles& all) {
  assert(surface.normals.size() == surface.positions.size() && surface.parts.size() == surface.triangles.size());
  assert(!surface.paint || surface.rest.size() == surface.positions.size());
  assert(surface.paint || !surface.texture || surface.on_texture.size() == surface.positions.size());
  // A vertex has one corner for each part of the body that meets at the vertex. The corners of a vertex form a linked
  // list.
  struct Made {
    Part part;
    std::uint32_t next;
  };
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  std::vector<std::uint32_t> first(surface.positions.size(), kNone);
  std::vector<Made> made;
  const std::size_t before = all.corners.size();
  // Returns the corner of this vertex that belongs to this part; adds the corner if it does not exist yet.
  const auto corner_of = [&](std::uint32_t vertex, Part part) {
    std::uint32_t* at = &first[vertex];
    while (*at != kNone && made[*at].part != part) at = &made[*at].next;
    if (*at != kNone) return *at;
    const auto added = static_cast<std::uint32_t>(made.size());
    *at = added;
    made.push_back({part, kNone});
    const glm::vec4 paint_and_label(ColourOf(surface, part), static_cast<std::uint32_t>(seen_as.value_or(part)));
    const glm::vec3 rest = surface.paint     ? surface.rest[vertex]
                           : surface.texture ? glm::vec3(surface.on_texture[vertex], 0)
                                             : glm::vec3(0);
    all.corners.push_back({glm::vec3(surface.positions[vertex] - eye), glm::vec3(surface.normals[vertex]),
                           paint_and_label, glm::vec4(rest, paint)});
    return added;
  };
  // Add every triangle whose corners can be drawn.
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    std::array<std::uint32_t, 3> triangle{};
    std::ranges::transform(surface.triangles[i], triangle.begin(), [&](std::uint32_t vertex) {
      return static_cast<std::uint32_t>(before) + corner_of(vertex, surface.parts[i]);
    });
    if (std::ranges::all_of(triangle, [&](std::uint32_t corner) { return IsDrawable(all.corners[corner]); })) {
      all.indices.insert(all.indices.end(), triangle.begin(), triangle.end());
    }
  }
}

}  // namespace

std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye) {
  std::vector<CapsuleInstance> instances;
  for (const Figure& figure : figures) AddInstances(figure, eye, instances);
  return instances;
}

void MakeTriangles(const std::vector<Figure>& figures, const glm::dvec3& eye, SurfaceTriangles& all) {
  for (Triangles* some : {&all.plain, &all.painted, &all.textured}) {
    some->corners.clear();
    some->indices.clear();
  }
  all.textures.clear();
  int paints = 0;
  for (const Figure& figure : figures) {
    for (const Surface& surface : figure.surfaces) {
      if (surface.paint) {
        AddTriangles(surface, figure.seen_as, paints++, eye, all.painted);
      } else if (surface.texture) {
        const std::size_t first = all.textured.indices.size();
        AddTriangles(surface, figure.seen_as, -1, eye, all.textured);
        all.textures.push_back({surface.texture, first, all.textured.indices.size() - first});
      } else {
        AddTriangles(surface, figure.seen_as, -1, eye, all.plain);
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
