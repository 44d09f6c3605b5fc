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

void RemarkOnFloating(const BodyMotion& motion, std::vector<std::string>& remarks) {
  constexpr double kHigh = 0.25, kLongestJump_s = 1;
  std::size_t longest = 0, last = 0, run = 0;
  for (std::size_t f = 0; f < motion.poses.size(); ++f) {
    run = motion.poses[f][LowestJoint(motion.poses[f])].y > kHigh ? run + 1 : 0;
    if (run <= longest) continue;
    longest = run;
    last = f;
  }
  const double seconds = static_cast<double>(longest) / motion.rate_hz;
  if (seconds <= kLongestJump_s) return;
  const double from = static_cast<double>(last + 1 - longest) / motion.rate_hz;
  remarks.push_back(
      fmt::format("floats: no joint is within 25 cm of the floor for {:.1f} s from {:.2f} s on; are there "
                  "steps, or is the floor elsewhere?",
                  seconds, from));
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
