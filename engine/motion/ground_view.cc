#include "engine/motion/ground_view.h"

#include <algorithm>
#include <cmath>

#include "engine/base/order_statistics.h"
#include "engine/motion/statistics.h"

namespace etude {
namespace {

using enum Role;

/// Returns the mode: the median of the values in the 2 cm interval that contains most values.
double Mode(std::vector<double> values) {
  constexpr double kWidth = 0.02;
  std::ranges::sort(values);
  std::size_t best = 0, count = 0;
  for (std::size_t i = 0, end = 0; i < values.size(); ++i) {
    while (end < values.size() && values[end] <= values[i] + kWidth) ++end;
    if (end - i <= count) continue;
    best = i;
    count = end - i;
  }
  const auto begin = values.begin() + static_cast<std::ptrdiff_t>(best);
  return Median({begin, begin + static_cast<std::ptrdiff_t>(count)});
}

/// Returns true if trunk and legs are upright. (Other poses do not show the floor's height: a seat, a cushion or
/// flesh may be between the joints and the floor.)
bool IsUprightPose(const BodyPose& pose) {
  constexpr double kSteep = 0.7;
  const glm::dvec3 trunk = pose[kShoulderCentre] - pose[kHipCentre];
  double leg = 0;
  for (const Role end : {kLeftKnee, kLeftAnkle, kRightKnee, kRightAnkle}) {
    leg += 0.5 * BoneLength(pose, {*ParentOf(end), end});
  }
  const double ankles = std::min(pose[kLeftAnkle].y, pose[kRightAnkle].y);
  return trunk.y > kSteep * glm::length(trunk) && pose[kHipCentre].y - ankles > kSteep * leg;
}

}  // namespace

GroundView::GroundView(const BodyMotion& motion, const Displacements& displacements, const FaultOptions& options)
    : motion_(motion), displacements_(displacements), offsets_(motion.poses.size()) {
  // Sum the displacements. `largest` is the offset of the frames within a displacement, `lasting` that of all later
  // frames.
  for (const Displacement& d : displacements.common) {
    for (int f = d.before + 1; f < d.after; ++f) offsets_[f] += d.largest;
    for (int f = d.after; f < frames(); ++f) offsets_[f] += d.lasting;
  }
  for (const BodyPose& pose : motion.poses) {
    is_upright_.push_back(IsUprightPose(pose));
    lowest_.push_back(LowestHeight(pose));
  }
  // Find the heights at which toes and ankles rest, in upright frames if there are enough.
  constexpr double kEnoughUpright = 0.3, kMaxAnkle = 0.25, kUsualAnkle = 0.08;
  const bool is_mostly_upright = UprightShare() > kEnoughUpright;
  std::vector<double> toes, ankles;
  for (int f = 0; f < frames(); ++f) {
    if (is_mostly_upright && !is_upright_[f]) continue;
    toes.push_back(std::min(Place(f, kLeftFoot).y, Place(f, kRightFoot).y));
    ankles.push_back(std::min(Place(f, kLeftAnkle).y, Place(f, kRightAnkle).y));
  }
  toe_rest_ = Mode(toes);
  ankle_rest_ = Mode(ankles);
  if (ankle_rest_ > toe_rest_ + kMaxAnkle) ankle_rest_ = toe_rest_ + kUsualAnkle;
  // Choose the floor. If the options contain a floor, use it. If height 0 may be the floor and the lowest joint comes
  // near height 0, the floor is at height 0. Otherwise, estimate the floor from the heights of the joints.
  constexpr double kFar = 0.6, kLow = 0.05, kBelowJoint = 0.02;
  const double low = Quantile(lowest_, kLow);
  is_floor_found_ = !options.floor_m && (!options.is_floor_known || std::abs(low) > kFar);
  if (options.floor_m) {
    floor_ = *options.floor_m;
  } else if (is_floor_found_) {
    floor_ = is_mostly_upright ? LowestRest() - kBelowJoint : low;
  }
}

double GroundView::FootHeight(int frame) const {
  return std::min({Place(frame, kLeftFoot).y - toe_rest_, Place(frame, kRightFoot).y - toe_rest_,
                   Place(frame, kLeftAnkle).y - ankle_rest_, Place(frame, kRightAnkle).y - ankle_rest_});
}

glm::dvec3 GroundView::Velocity(int frame, Role role) const {
  constexpr double kReach_s = 1.0 / 15;
  const int reach = std::max(static_cast<int>(std::lround(kReach_s * motion_.rate_hz)), 1);
  const int middle = frames() > 2 * reach ? std::clamp(frame, reach, frames() - 1 - reach) : frame;
  const int from = std::max(middle - reach, 0), to = std::min(middle + reach, frames() - 1);
  return (Place(to, role) - Place(from, role)) * (motion_.rate_hz / (to - from));
}

bool GroundView::IsOnFeet(int frame) const {
  constexpr double kNear = 0.2;
  return std::ranges::all_of(AllRoles(), [&](Role role) {
    const bool is_end = std::ranges::find(kFootJoints, role) != kFootJoints.end();
    return is_end || role == kLeftHand || role == kRightHand || Place(frame, role).y - LowestRest() > kNear;
  });
}

double GroundView::UprightShare(const FrameRange& range) const {
  const auto from = is_upright_.begin() + range.first, to = is_upright_.begin() + range.last + 1;
  return static_cast<double>(std::count(from, to, true)) / (range.last - range.first + 1);
}

}  // namespace etude
