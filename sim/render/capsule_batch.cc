#include "sim/render/capsule_batch.h"

#include <algorithm>
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

}  // namespace

std::vector<CapsuleInstance> MakeInstances(const std::vector<Figure>& figures, const glm::dvec3& eye) {
  std::vector<CapsuleInstance> instances;
  for (const Figure& figure : figures) AddInstances(figure, eye, instances);
  return instances;
}

}  // namespace etude
