#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/cameras/limb_direction.h"
#include "engine/motion/body.h"
#include "sim/annotator/evidence.h"
#include "sim/body/shape.h"

namespace etude {

/// Returns the nearest part of `body` at every pixel, by ray casting, independently of the renderer.
inline LabelImage LabelsOf(const std::vector<Capsule>& body, const Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  LabelImage labels(in.width, in.height);
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      const glm::dvec3 ray_C((x + 0.5 - in.cx) / in.fx, (y + 0.5 - in.cy) / in.fy, 1);
      const glm::dvec3 ray_W = glm::normalize(glm::transpose(camera.R_CW) * ray_C);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Capsule& capsule : body) {
        const double hit = HitDistance(capsule, camera.p_WC, ray_W);
        if (hit < nearest) {
          nearest = hit;
          labels.At(x, y) = static_cast<std::uint32_t>(capsule.part);
        }
      }
    }
  }
  return labels;
}

/// A label picture in which every limb is visible and lies wholly on the person.
struct Shown {
  LabelImage labels;
  ColourImage colours;
  Mask person;

  explicit Shown(LabelImage of)
      : labels(std::move(of)), colours(labels.width, labels.height), person(labels.width, labels.height, 1) {
    for (std::size_t i = 0; i < labels.pixels.size(); ++i) {
      if (IsPerformer(labels.pixels[i])) colours.pixels[i] = {200, 200, 200};
    }
  }
  AnnotatedPicture picture() const { return {labels, colours, person}; }
};

/// Returns a standing person with the arms half raised, about 1.8 m tall.
inline BodyPose StandingBody() {
  using enum Role;
  BodyPose pose;
  pose[kHipCentre] = {0, 0.95, 0};
  pose[kSpine] = {0, 1.15, 0};
  pose[kShoulderCentre] = {0, 1.45, 0};
  pose[kHead] = {0, 1.7, 0.02};
  for (const double side : {1.0, -1.0}) {
    const bool left = side > 0;
    pose[left ? kLeftShoulder : kRightShoulder] = {side * 0.18, 1.43, 0};
    pose[left ? kLeftElbow : kRightElbow] = {side * 0.42, 1.3, 0.05};
    pose[left ? kLeftWrist : kRightWrist] = {side * 0.6, 1.48, 0.12};
    pose[left ? kLeftHand : kRightHand] = {side * 0.72, 1.6, 0.15};
    pose[left ? kLeftHip : kRightHip] = {side * 0.1, 0.92, 0};
    pose[left ? kLeftKnee : kRightKnee] = {side * 0.12, 0.5, 0.03};
    pose[left ? kLeftAnkle : kRightAnkle] = {side * 0.13, 0.08, 0};
    pose[left ? kLeftFoot : kRightFoot] = {side * 0.15, 0.03, 0.18};
  }
  return pose;
}

/// Returns intrinsics of a picture as small as the tests allow.
inline Intrinsics NarrowPicture() { return {.width = 300, .height = 400, .cx = 150, .cy = 200}; }

inline Camera FrontCamera() { return LookAt(NarrowPicture(), {1.5, 1.4, 3.5}, {0, 0.95, 0}); }
inline Camera SideCamera() { return LookAt(NarrowPicture(), {3.8, 1.2, 0}, {0, 0.95, 0}); }

inline std::size_t StrokeTo(Role role) {
  std::size_t i = 0;
  while (StrokeMarks()[i].to != role) ++i;
  return i;
}

inline double LineDistance(const glm::dvec2& p, const PixelSegment& line) {
  const glm::dvec2 d = glm::normalize(line.b - line.a), r = p - line.a;
  return std::abs(d.x * r.y - d.y * r.x);
}

}  // namespace etude
