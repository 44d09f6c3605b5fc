#include "tests/sim/choreography/varied_library.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "engine/base/directions.h"
#include "engine/motion/edit.h"

// A named namespace, because this file is compiled together with others that have types of the same names.
namespace etude {
namespace varied_library {

using enum Role;

/// The parts of the body whose rotations are scaled together.
enum class Part { kTrunk, kLeftArm, kRightArm, kLeftLeg, kRightLeg };
constexpr std::size_t kPartCount = 5;
/// Marks hips and shoulders, which carry the other parts and are not scaled.
constexpr Part kNoPart{kPartCount};

constexpr std::array<Part, kRoleCount> kPartOfChildren = {
    kNoPart, Part::kTrunk,    Part::kTrunk,    Part::kTrunk,     // the centre, from the hip centre to the head
    kNoPart, Part::kLeftArm,  Part::kLeftArm,  Part::kLeftArm,   // from the shoulder to the hand
    kNoPart, Part::kRightArm, Part::kRightArm, Part::kRightArm,  //
    kNoPart, Part::kLeftLeg,  Part::kLeftLeg,  Part::kLeftLeg,   // from the hip to the foot
    kNoPart, Part::kRightLeg, Part::kRightLeg, Part::kRightLeg,  //
};

/// A number that oscillates slowly about a centre.
struct Oscillation {
  double middle, swing, period_s, phase;

  static Oscillation Draw(double low, double high, double swing, RandomStream& stream) {
    const double middle = stream.Uniform(low + swing, high - swing);
    const double period_s = stream.Uniform(3, 9);
    return {middle, swing, period_s, stream.Uniform(0, 2 * std::numbers::pi)};
  }
  double At(double seconds) const {
    return middle + swing * std::sin(2 * std::numbers::pi * seconds / period_s + phase);
  }
};

/// The directions of the limbs, indexed by their child joint, in the frame of a body that faces +Z.
using Directions = std::array<glm::dvec3, kRoleCount>;

Directions DirectionsOf(const BodyPose& pose) {
  const FloorMove to_front{.yaw = -Heading(pose)};
  Directions directions{};
  for (const Bone& bone : AllBones()) {
    directions[Index(bone.child)] = UnitOr(to_front.Apply(pose[bone.child] - pose[bone.parent]), {0, 1, 0});
  }
  return directions;
}

struct MeanPose {
  Directions directions{};
  double hip_height = 0;
};

MeanPose ComputeMean(const BodyMotion& motion) {
  MeanPose mean;
  for (const BodyPose& pose : motion.poses) {
    const Directions directions = DirectionsOf(pose);
    for (const Bone& bone : AllBones()) mean.directions[Index(bone.child)] += directions[Index(bone.child)];
    mean.hip_height += pose[kHipCentre].y / static_cast<double>(motion.poses.size());
  }
  for (glm::dvec3& direction : mean.directions) direction = UnitOr(direction, {0, 1, 0});
  return mean;
}

/// Returns `direction`, rotated in the plane with `centre` until its angle to `centre` is `factor` times as large, at
/// most π.
glm::dvec3 ScaleTurn(const glm::dvec3& direction, const glm::dvec3& centre, double factor) {
  const double along = glm::dot(direction, centre);
  const glm::dvec3 across = direction - along * centre;
  const double sine = glm::length(across);
  constexpr double kSame = 1e-9;
  if (sine < kSame) return direction;
  const double angle = std::min(factor * std::atan2(sine, along), std::numbers::pi);
  return std::cos(angle) * centre + std::sin(angle) * (across / sine);
}

/// Returns the pose at a fractional frame, by linear interpolation of joints. `Vary` restores the limb lengths.
BodyPose PoseAt(const BodyMotion& motion, double frame) {
  const auto before = static_cast<std::size_t>(frame);
  const std::size_t after = std::min(before + 1, motion.poses.size() - 1);
  const double part = frame - static_cast<double>(before);
  BodyPose pose;
  for (Role role : AllRoles()) pose[role] = glm::mix(motion.poses[before][role], motion.poses[after][role], part);
  return pose;
}

struct Style {
  Oscillation tempo;
  std::array<Oscillation, kPartCount> amplitudes;

  static Style Draw(RandomStream& stream) {
    Style style{.tempo = Oscillation::Draw(0.7, 1.4, 0.1, stream), .amplitudes = {}};
    for (Oscillation& amplitude : style.amplitudes) amplitude = Oscillation::Draw(0.6, 1.3, 0.1, stream);
    return style;
  }
};

/// Returns `pose` performed in a style. `mean` is the mean pose of its motion; the limb lengths come from `lengths`.
BodyPose Vary(const BodyPose& pose, const BodyPose& lengths, const MeanPose& mean, const Style& style, double seconds) {
  const Directions directions = DirectionsOf(pose);
  const FloorMove to_world{.yaw = Heading(pose)};
  BodyPose varied;
  varied[kHipCentre] = pose[kHipCentre];
  const double trunk = style.amplitudes[static_cast<std::size_t>(Part::kTrunk)].At(seconds);
  varied[kHipCentre].y = mean.hip_height + trunk * (pose[kHipCentre].y - mean.hip_height);
  for (const Bone& bone : AllBones()) {
    const std::size_t child = Index(bone.child);
    glm::dvec3 direction = directions[child];
    if (const Part part = kPartOfChildren[Index(bone.child)]; part != kNoPart) {
      const double factor = style.amplitudes[static_cast<std::size_t>(part)].At(seconds);
      direction = ScaleTurn(direction, mean.directions[child], factor);
    }
    varied[bone.child] = varied[bone.parent] + BoneLength(lengths, bone) * to_world.Apply(direction);
  }
  return varied;
}

BodyMotion Perform(const BodyMotion& seed, const MeanPose& mean, RandomStream& stream) {
  const Style style = Style::Draw(stream);
  const bool is_mirrored = stream.Chance(0.5);
  BodyMotion performed{.rate_hz = seed.rate_hz, .poses = {}};
  const double last = static_cast<double>(seed.poses.size() - 1);
  double seconds = 0;
  for (double at = stream.Uniform(); at <= last; at += style.tempo.At(seconds)) {
    const BodyPose& lengths = seed.poses[static_cast<std::size_t>(at)];
    performed.poses.push_back(Vary(PoseAt(seed, at), lengths, mean, style, seconds));
    seconds += 1 / seed.rate_hz;
  }
  return is_mirrored ? Mirror(performed) : performed;
}

}  // namespace varied_library

std::vector<BodyMotion> VariedLibrary(std::span<const BodyMotion> seeds, int frames, RandomStream& stream) {
  std::vector<varied_library::MeanPose> means;
  for (const BodyMotion& seed : seeds) {
    assert(seed.poses.size() >= 2);
    means.push_back(varied_library::ComputeMean(seed));
  }
  std::vector<BodyMotion> library;
  auto left = static_cast<std::size_t>(std::max(frames, 0));
  for (std::size_t turn = 0; left > 0; turn = (turn + 1) % seeds.size()) {
    BodyMotion clip = varied_library::Perform(seeds[turn], means[turn], stream);
    clip.poses.resize(std::min(clip.poses.size(), left));
    left -= clip.poses.size();
    library.push_back(std::move(clip));
  }
  return library;
}

}  // namespace etude
