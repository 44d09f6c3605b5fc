#include "reports/clips/remarks.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/capture/fit_pose.h"

namespace etude {
namespace {

/// The lowest joint of a pose, finger tips aside: rigs place them carelessly.
Role LowestJoint(const BodyPose& pose) {
  Role lowest = Role::kHipCentre;
  for (const Role role : AllRoles()) {
    const bool is_finger_tip = role == Role::kLeftHand || role == Role::kRightHand;
    if (!is_finger_tip && pose[role].y < pose[lowest].y) lowest = role;
  }
  return lowest;
}

void RemarkOnPenetration(const BodyMotion& motion, std::vector<std::string>& remarks) {
  constexpr double kDeep = 0.05;
  double depth = 0;
  std::size_t deepest = 0, frames = 0;
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    const double here = -motion.poses[f][LowestJoint(motion.poses[f])].y;
    if (here > kDeep) ++frames;
    if (here <= depth) continue;
    depth = here;
    deepest = f;
  }
  if (depth <= kDeep) return;
  remarks.push_back(fmt::format(
      "{} is {:.0f} cm below the floor at {:.2f} s; {:.0f} % of the frames are over 5 cm deep",
      RoleName(LowestJoint(motion.poses[deepest])), 100 * depth, static_cast<double>(deepest) / motion.rate_hz,
      100.0 * static_cast<double>(frames) / static_cast<double>(motion.poses.size())));
}

/// True if trunk and legs stand: who sits or lies has seats, cushions and the body's own thickness below the joints.
bool IsUpright(const BodyPose& pose) {
  constexpr double kSteep = 0.7;
  using enum Role;
  const glm::dvec3 trunk = pose[kShoulderCentre] - pose[kHipCentre];
  const double leg = glm::distance(pose[kLeftHip], pose[kLeftKnee]) + glm::distance(pose[kLeftKnee], pose[kLeftAnkle]);
  const double ankles = std::min(pose[kLeftAnkle].y, pose[kRightAnkle].y);
  return trunk.y > kSteep * glm::length(trunk) && pose[kHipCentre].y - ankles > kSteep * leg;
}

/// A height at which a body may stay, and for how long: nobody jumps for a second, some sit on high chairs, and of who
/// dances toes lie up to 5 cm above the lowest twentieth for two seconds, 9 for one.
struct Hovering {
  double height_m, longest_s;
  bool is_upright;
};
constexpr Hovering kHoverings[] = {{0.5, 1, false}, {0.25, 1, true}, {0.09, 2, true}};

void RemarkOnFloating(const BodyMotion& motion, std::vector<std::string>& remarks) {
  for (const Hovering& kind : kHoverings) {
    std::size_t longest = 0, last = 0, run = 0;
    for (std::size_t f = 0; f < motion.poses.size(); ++f) {
      const BodyPose& pose = motion.poses[f];
      const bool hovers = pose[LowestJoint(pose)].y > kind.height_m && (!kind.is_upright || IsUpright(pose));
      run = hovers ? run + 1 : 0;
      if (run <= longest) continue;
      longest = run;
      last = f;
    }
    const double seconds = static_cast<double>(longest) / motion.rate_hz;
    if (seconds <= kind.longest_s) continue;
    remarks.push_back(fmt::format(
        "floats: no joint is within {:.0f} cm of the floor for {:.1f} s from {:.2f} s on; are there steps, or is the "
        "floor elsewhere?",
        100 * kind.height_m, seconds, static_cast<double>(last + 1 - longest) / motion.rate_hz));
    return;
  }
}

}  // namespace

std::vector<std::string> RemarksOn(const BodyMotion& motion, const MotionStatistics& statistics) {
  constexpr double kFast_m_s = 10;  // sprinters' feet
  std::vector<std::string> remarks;
  if (statistics.speed_median_m_s > kFast_m_s) {
    remarks.push_back(fmt::format("the fastest joint moves at {:.1f} m/s in the median frame; is the frame time right?",
                                  statistics.speed_median_m_s));
  }
  RemarkOnPenetration(motion, remarks);
  RemarkOnFloating(motion, remarks);
  return remarks;
}

std::optional<std::string> RemarkOnSliding(const BodyMotion& motion, const RestBody& rest) {
  constexpr std::size_t kMostPoses = 120;
  constexpr double kLeast = 0.002, kMmPerMetre = 1000;
  const auto misfit = MeasureRigidMisfit(rest, motion.poses, kMostPoses);
  if (!misfit || misfit->mean_m < kLeast) return std::nullopt;
  return fmt::format(
      "joints slide: a skeleton that keeps its lengths stays {:.1f} mm off (worst joint, mean over the frames), {:.0f} "
      "mm at {:.2f} s ({})",
      kMmPerMetre * misfit->mean_m, kMmPerMetre * misfit->worst_m, static_cast<double>(misfit->pose) / motion.rate_hz,
      RoleName(misfit->role));
}

}  // namespace etude
