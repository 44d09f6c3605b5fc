#include "bench/tasks/base/disguise.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/angles.h"
#include "engine/base/euler.h"

namespace etude {
namespace {

using enum Role;

constexpr double kKnotSeconds = 0.5;

/// The root mean square over time of a cubic B-spline whose coefficients have a standard deviation of 1.
constexpr double kSplineDeviation = 0.692;

/// The random turn of a limb about its upper joint. It is added to the turn of the limb's parent.
struct LimbTurn {
  Role child;
  double turn_deg = 0;  ///< standard deviation of the turn about each of three axes
  double bend = 0;      ///< standard deviation of the turn about BendAxis, radians, per unit of the axis's length
};

constexpr std::array kTurns = {
    LimbTurn{kSpine, 2},      LimbTurn{kShoulderCentre, 3},  LimbTurn{kHead, 5},
    LimbTurn{kLeftElbow, 6},  LimbTurn{kLeftWrist, 0, 0.2},  LimbTurn{kLeftHand, 5},
    LimbTurn{kRightElbow, 6}, LimbTurn{kRightWrist, 0, 0.2}, LimbTurn{kRightHand, 5},
    LimbTurn{kLeftKnee, 3},   LimbTurn{kLeftAnkle, 0, 0.2},  LimbTurn{kLeftFoot, 4},
    LimbTurn{kRightKnee, 3},  LimbTurn{kRightAnkle, 0, 0.2}, LimbTurn{kRightFoot, 4},
};

glm::dmat3 TurnBy(const glm::dvec3& turn) {
  const double angle = glm::length(turn);
  return angle > 0 ? AxisRotation(turn / angle, angle) : glm::dmat3(1);
}

/// Returns the axis about which the limb to `child` bends relative to its parent limb. The length of the axis is the
/// sine of the angle between the two limbs.
glm::dvec3 BendAxis(const BodyPose& pose, Role child) {
  const Role upper = *ParentOf(child);
  const glm::dvec3 above = pose[upper] - pose[*ParentOf(upper)], limb = pose[child] - pose[upper];
  const double size = glm::length(above) * glm::length(limb);
  return size > 0 ? glm::cross(above, limb) / size : glm::dvec3(0);
}

double LowestOf(const BodyPose& pose) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const glm::dvec3& joint : pose.joints) lowest = std::min(lowest, joint.y);
  return lowest;
}

/// The random turn of one limb over time.
class WanderingTurn {
 public:
  WanderingTurn(const WorldKey& key, const LimbTurn& limb) : limb_(limb) {
    for (const char* axis : {"x", "y", "z"}) {
      dice_.emplace_back(key, fmt::format("disguise/{}/{}", RoleName(limb.child), axis));
      if (limb.bend != 0) break;
    }
  }

  glm::dmat3 At(double seconds, const BodyPose& pose) {
    if (limb_.bend != 0) return TurnBy(limb_.bend * dice_[0].At(seconds) * BendAxis(pose, limb_.child));
    glm::dvec3 turn;
    for (int i = 0; i < 3; ++i) turn[i] = Radians(limb_.turn_deg) * dice_[static_cast<std::size_t>(i)].At(seconds);
    return TurnBy(turn);
  }

 private:
  const LimbTurn limb_;
  std::vector<SmoothRandomFunction> dice_;
};

}  // namespace

SmoothRandomFunction::SmoothRandomFunction(const WorldKey& key, std::string_view purpose)
    : dice_(key, purpose), constant_(dice_.Normal()) {}

double SmoothRandomFunction::At(double seconds) {
  const double knot = std::floor(seconds / kKnotSeconds), u = seconds / kKnotSeconds - knot;
  const auto first = static_cast<std::size_t>(knot);
  while (knots_.size() < first + 4) knots_.push_back(dice_.Normal());
  const double w = 1 - u;
  const double spline = (w * w * w * knots_[first] + (3 * u * u * u - 6 * u * u + 4) * knots_[first + 1] +
                         (3 * w * w * w - 6 * w * w + 4) * knots_[first + 2] + u * u * u * knots_[first + 3]) /
                        6;
  return std::sqrt(0.5) * (constant_ + spline / kSplineDeviation);
}

BodyPose PoseOfClip(std::span<const BodyPose> clip, double frame) {
  const auto before = static_cast<std::size_t>(frame);
  const double part = frame - std::floor(frame);
  const BodyPose& a = clip[before % clip.size()];
  const BodyPose& b = clip[(before + 1) % clip.size()];
  BodyPose pose;
  for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = glm::mix(a.joints[i], b.joints[i], part);
  return pose;
}

Disguise::Disguise(const WorldKey& key) : key_(key) {
  RandomStream dice(key, "disguise");
  scale_ = dice.Uniform(11.0 / 12, 13.0 / 12);
  pace_ = dice.Uniform(6.0 / 7, 1);
  offset_ = dice.Uniform();
}

double Disguise::FrameOf(double start, double step, std::size_t count, double last) const {
  return std::min(last, start + offset_ + pace_ * step * static_cast<double>(count));
}

void Disguise::ApplyTo(std::vector<BodyPose>& window, double rate_hz) const {
  std::vector<WanderingTurn> turns;
  for (const LimbTurn& limb : kTurns) turns.emplace_back(key_, limb);
  for (std::size_t k = 0; k < window.size(); ++k) {
    // Draw the turn of each limb at this time.
    const BodyPose old = window[k];
    std::array<glm::dmat3, kRoleCount> turned;
    turned[Index(kHipCentre)] = glm::dmat3(1);
    std::array<std::optional<glm::dmat3>, kRoleCount> own;
    for (std::size_t i = 0; i < turns.size(); ++i) {
      own[Index(kTurns[i].child)] = turns[i].At(static_cast<double>(k) / rate_hz, old);
    }
    // Apply the turns from the pelvis outwards. Each limb also turns with its parent.
    BodyPose& pose = window[k];
    for (const Bone& bone : AllBones()) {
      // The pelvis is rigid, so both hips turn with the spine. The chest is rigid, so shoulders have no turn of their
      // own.
      const bool is_hip = bone.child == kLeftHip || bone.child == kRightHip;
      glm::dmat3& turn = turned[Index(bone.child)];
      turn = turned[Index(is_hip ? kSpine : bone.parent)];
      if (own[Index(bone.child)]) turn = turn * *own[Index(bone.child)];
      pose[bone.child] = pose[bone.parent] + turn * (old[bone.child] - old[bone.parent]);
    }
    // Restore the height of the lowest joint, then scale the body.
    const glm::dvec3 onto_floor(0, LowestOf(old) - LowestOf(pose), 0);
    for (glm::dvec3& joint : pose.joints) joint = scale_ * (joint + onto_floor);
  }
}

}  // namespace etude
