#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/motion/clip.h"

namespace etude::testing {

/// Returns a person with the default limb lengths in centimetres, in a T-pose with the toes on the floor, with
/// MotionBuilder's joint names. This table shows every length.
inline Skeleton PersonSkeleton() {
  Skeleton person;
  const auto add = [&](const std::string& name, const std::string& parent, glm::dvec3 offset) {
    person.joints.push_back({name, person.Find(parent), {.translation = offset}, name.ends_with("_End")});
  };
  add("Hips", "", {0, 95, 0});
  add("Spine", "Hips", {0, 20, 0});
  add("Neck", "Spine", {0, 25, 0});
  add("Head", "Neck", {0, 10, 0});
  add("Head_End", "Head", {0, 15, 0});
  for (const auto& [side, sign] : {std::pair{"Left", 1}, std::pair{"Right", -1}}) {
    const std::string s = side;
    add(s + "Shoulder", "Spine", {sign * 4, 22, 0});
    add(s + "Arm", s + "Shoulder", {sign * 14, 0, 0});
    add(s + "ForeArm", s + "Arm", {sign * 29, 0, 0});
    add(s + "Hand", s + "ForeArm", {sign * 25, 0, 0});
    add(s + "Hand_End", s + "Hand", {sign * 18, 0, 0});
    add(s + "UpLeg", "Hips", {sign * 9, -5, 0});
    add(s + "Leg", s + "UpLeg", {0, -43, 0});
    add(s + "Foot", s + "Leg", {0, -42, 0});
    add(s + "ToeBase", s + "Foot", {0, -5, 12});
    add(s + "ToeBase_End", s + "ToeBase", {0, 0, 6});
  }
  return person;
}

inline Clip AtRest(const Skeleton& skeleton, int count = 1, double rate_hz = 30) {
  const LocalPose rest = RestPose(skeleton);
  return {.name = "person", .skeleton = skeleton, .rate_hz = rate_hz, .frames = std::vector<LocalPose>(count, rest)};
}

inline LocalTransform& At(Clip& clip, std::size_t frame, const std::string& joint) {
  return clip.frames[frame][clip.skeleton.Find(joint)];
}

inline glm::dquat Turn(double radians, const glm::dvec3& axis) { return glm::angleAxis(radians, axis); }

inline void LowerArms(Clip& clip, std::size_t frame) {
  At(clip, frame, "LeftArm").rotation = Turn(-1.5, {0, 0, 1});
  At(clip, frame, "RightArm").rotation = Turn(1.5, {0, 0, 1});
}

}  // namespace etude::testing
