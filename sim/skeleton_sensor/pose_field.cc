#include "sim/skeleton_sensor/pose_field.h"

#include <cmath>

#include "engine/base/angles.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {
namespace {

using enum Role;

bool IsLeft(Role role) { return RoleName(role).starts_with("left"); }

}  // namespace

PoseField::PoseField(Role role, const PoseLengths& lengths, RandomStream& dice) {
  const auto see = [&](Role joint, bool from_shoulders, double length) {
    seen_[seen_count_++] = {joint, from_shoulders, length};
  };
  const auto see_arms = [&] {
    for (const Role joint : {kLeftElbow, kLeftWrist, kRightElbow, kRightWrist}) see(joint, true, lengths.far);
  };
  switch (GroupOf(role)) {
    case JointGroup::kElbows:
    case JointGroup::kWrists:
    case JointGroup::kHands:
      see(IsLeft(role) ? kLeftElbow : kRightElbow, true, lengths.own);
      see(IsLeft(role) ? kLeftWrist : kRightWrist, true, lengths.own);
      break;
    case JointGroup::kFeet:
      see(role, false, lengths.own);
      break;
    default:
      see(role, false, lengths.own);
      see_arms();
  }
  for (Wave& wave : waves_) {
    wave.direction = dice.Normal3() * std::sqrt(2.0 / kWaves);
    wave.phase = dice.Uniform(0, 2 * kPi);
    // As many throws whatever the joint sees.
    for (std::size_t i = 0; i < kMostPlaces; ++i) {
      const glm::dvec3 thrown = dice.Normal3();
      wave.per_metre[i] = i < seen_count_ ? thrown / seen_[i].length : glm::dvec3(0);
    }
  }
}

glm::dvec3 PoseField::At(const BodyPose& pose) const {
  std::array<glm::dvec3, kMostPlaces> places;
  for (std::size_t i = 0; i < seen_count_; ++i) {
    places[i] = pose[seen_[i].joint] - (seen_[i].from_shoulders ? pose[kShoulderCentre] : glm::dvec3(0));
  }
  glm::dvec3 sum(0);
  for (const Wave& wave : waves_) {
    double phase = wave.phase;
    for (std::size_t i = 0; i < seen_count_; ++i) phase += glm::dot(wave.per_metre[i], places[i]);
    sum += wave.direction * std::cos(phase);
  }
  return sum;
}

}  // namespace etude
