#include "engine/motion/limb_faults.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <initializer_list>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/base/order_statistics.h"
#include "engine/motion/fault_limits.h"

namespace etude {
namespace {

using enum Role;

struct Leg {
  Role hip, knee, ankle, foot;
};
struct Arm {
  Role elbow, wrist, hand;
};
constexpr std::array kLegs = {Leg{kLeftHip, kLeftKnee, kLeftAnkle, kLeftFoot},
                              Leg{kRightHip, kRightKnee, kRightAnkle, kRightFoot}};
constexpr std::array kArms = {Arm{kLeftElbow, kLeftWrist, kLeftHand}, Arm{kRightElbow, kRightWrist, kRightHand}};

/// Appends a fault for every stretch of at least `min_s` seconds in which `value` is above `limit`. A stretch includes
/// gaps of less than 0.4 s in which `value` is not above `limit`. A fault's size is its largest value.
void AppendRanges(const BodyMotion& motion, const std::vector<double>& value, double limit, double min_s,
                  MotionFault fault, std::vector<MotionFault>& faults) {
  std::vector<bool> is_beyond;
  constexpr double kMaxGap_s = 0.4;
  int last = -1;  // the last frame above the limit
  for (const double v : value) {
    const int f = static_cast<int>(is_beyond.size());
    is_beyond.push_back(v > limit);
    if (v <= limit) continue;
    if (last >= 0 && f - last < kMaxGap_s * motion.rate_hz) std::fill(is_beyond.begin() + last, is_beyond.end(), true);
    last = f;
  }
  for (const FrameRange& span : RangesOf(is_beyond)) {
    if ((span.last - span.first + 1) / motion.rate_hz < min_s) continue;
    fault.from_s = span.first / motion.rate_hz;
    fault.to_s = span.last / motion.rate_hz;
    fault.size = *std::max_element(value.begin() + span.first, value.begin() + span.last + 1);
    faults.push_back(fault);
  }
}

/// Returns true if a frame shows all of these joints.
bool Shows(std::span<const JointSet> unseen, int frame, std::initializer_list<Role> joints) {
  if (unseen.empty()) return true;
  return std::ranges::none_of(joints, [&](Role joint) { return unseen[frame][Index(joint)]; });
}

/// The changes of a limb's length, relative to its median.
struct LengthChanges {
  Role end = kHead;           ///< the limb's far end
  std::vector<double> share;  ///< absolute change by frame, as a share of the median; 0 in ignored frames
  double usual = 0;           ///< median of the absolute changes over all frames that show the limb
};

/// Returns the length changes of upper arms, forearms, thighs and shanks. Frames near pops are ignored.
std::vector<LengthChanges> FindLengthChanges(const BodyMotion& motion, std::span<const JointSet> unseen,
                                             const std::vector<Pop>& pops) {
  constexpr double kMinLength = 0.02;
  constexpr int kNearPop = 2;
  constexpr std::array kFarEnds = {kLeftElbow, kLeftWrist, kRightElbow, kRightWrist,
                                   kLeftKnee,  kLeftAnkle, kRightKnee,  kRightAnkle};
  const int frames = static_cast<int>(motion.poses.size());
  std::vector<bool> pops_here(frames);
  for (const Pop& pop : pops) {
    const int to = std::min(pop.frames.last + kNearPop, frames - 1);
    for (int f = std::max(pop.frames.first - kNearPop, 0); f <= to; ++f) pops_here[f] = true;
  }
  std::vector<LengthChanges> all;
  for (const Role end : kFarEnds) {
    std::vector<double> lengths(frames), seen;
    for (int f = 0; f < frames; ++f) {
      if (!Shows(unseen, f, {*ParentOf(end), end})) continue;
      lengths[f] = BoneLength(motion.poses[f], {*ParentOf(end), end});
      seen.push_back(lengths[f]);
    }
    const double median = seen.empty() ? 0 : Median(seen);
    if (median < kMinLength) continue;
    for (double& length : seen) length = std::abs(length / median - 1);
    LengthChanges changes{.end = end, .share = std::vector<double>(frames), .usual = Median(seen)};
    for (int f = 0; f < frames; ++f) {
      const bool counts = Shows(unseen, f, {*ParentOf(end), end}) && !pops_here[f];
      if (counts) changes.share[f] = std::abs(lengths[f] / median - 1);
    }
    all.push_back(std::move(changes));
  }
  return all;
}

/// Appends limbs whose lengths differ from their medians by more than 3 % for at least 0.05 s and at least three
/// frames in all. One fault of a limb covers all frames with such a difference. If joints were found from markers,
/// skin that moves over the bones changes the lengths; the difference must then also exceed fifteen times the usual
/// deviation.
void FindStretches(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                   std::vector<MotionFault>& faults) {
  constexpr int kMinFrames = 3;
  const std::vector<LengthChanges> limbs = FindLengthChanges(motion, options.unseen, pops);
  if (limbs.empty()) return;
  std::vector<double> usual;
  for (const LengthChanges& limb : limbs) usual.push_back(limb.usual);
  const double usual_of_all = Median(usual);
  for (const LengthChanges& limb : limbs) {
    const double softness = options.is_of_markers ? std::max(limb.usual, usual_of_all) : 0;
    const double limit = std::max(fault_limits::kStretch, fault_limits::kStretchTimesUsual * softness);
    FrameRange all{static_cast<int>(limb.share.size()), -1};
    double largest = 0;
    int count = 0;
    for (int f = 0; f < static_cast<int>(limb.share.size()); ++f) {
      if (limb.share[f] <= limit) continue;
      all = {std::min(all.first, f), f};
      largest = std::max(largest, limb.share[f]);
      ++count;
    }
    if (count < kMinFrames || count < fault_limits::kStretch_s * motion.rate_hz) continue;
    faults.push_back({FaultKind::kStretches, all.first / motion.rate_hz, all.last / motion.rate_hz, limb.end, largest,
                      count <= all.last - all.first ? count / motion.rate_hz : 0});
  }
}

void FindBends(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto [hip, knee, ankle, foot] = kLegs[side == Side::kLeft ? 0 : 1];
    std::vector<double> angles;
    for (int f = 0; f < static_cast<int>(motion.poses.size()); ++f) {
      const bool is_seen = Shows(unseen, f, {hip, knee, ankle});
      angles.push_back(is_seen ? KneeOverextension(motion.poses[f], side, Shows(unseen, f, {foot})) : 0);
    }
    AppendRanges(motion, angles, fault_limits::kBend_deg, fault_limits::kBend_s,
                 {.kind = FaultKind::kBends, .joint = knee}, faults);
  }
}

void FindPasses(const BodyMotion& motion, std::span<const JointSet> unseen, std::vector<MotionFault>& faults) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto [elbow, wrist, hand] = kArms[side == Side::kLeft ? 0 : 1];
    std::vector<double> depth;
    for (int f = 0; f < static_cast<int>(motion.poses.size()); ++f) {
      const bool is_seen = Shows(unseen, f, {elbow, wrist}), sees_hand = Shows(unseen, f, {hand});
      depth.push_back(is_seen ? -ArmFromSpine(motion.poses[f], side, sees_hand) : -1);
    }
    const std::size_t first = faults.size();
    AppendRanges(motion, depth, -fault_limits::kPass_m, fault_limits::kPass_s,
                 {.kind = FaultKind::kPasses, .joint = wrist}, faults);
    for (std::size_t i = first; i < faults.size(); ++i) faults[i].size *= -1;
  }
}

}  // namespace

std::optional<glm::dvec3> FrontByToes(const BodyPose& pose, Side side) {
  constexpr double kMinShare = 0.6;  // the toes are at least 37° from the line of the shank
  const auto [hip, knee, ankle, foot] = kLegs[side == Side::kLeft ? 0 : 1];
  const glm::dvec3 toes = pose[foot] - pose[ankle], shank = UnitOr(pose[ankle] - pose[knee], {0, -1, 0});
  const glm::dvec3 front = toes - glm::dot(toes, shank) * shank;
  if (glm::length(front) <= kMinShare * glm::length(toes)) return std::nullopt;
  return glm::normalize(front);
}

double KneeOverextension(const BodyPose& pose, Side side, bool sees_toes) {
  constexpr double kMinBackwards = 0.2;  // cosine between bending axis and hip line; 0.1 for a leg turned outwards
  const auto [hip, knee, ankle, foot] = kLegs[side == Side::kLeft ? 0 : 1];
  const glm::dvec3 thigh = pose[knee] - pose[hip], shank = pose[ankle] - pose[knee], axis = glm::cross(thigh, shank);
  const double backwards = glm::dot(axis, UnitOr(pose[kRightHip] - pose[kLeftHip], {-1, 0, 0}));
  if (backwards <= kMinBackwards * glm::length(axis)) return 0;
  const auto front = sees_toes ? FrontByToes(pose, side) : std::nullopt;
  if (!front) return Degrees(std::atan2(backwards, glm::dot(thigh, shank)));
  return std::max(0.0, -Degrees(std::atan2(glm::dot(thigh, *front), glm::dot(thigh, glm::normalize(shank)))));
}

double SegmentDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  constexpr double kTiny = 1e-12;
  const glm::dvec3 u = b - a, v = d - c, w = a - c;
  const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v), uw = glm::dot(u, w), vw = glm::dot(v, w);
  const double normal = uu * vv - uv * uv;
  // Take the first line's point nearest to the second line, then the second segment's point nearest to this point, then
  // the first segment's point nearest to the second segment's point.
  double s = normal > kTiny ? std::clamp((uv * vw - uw * vv) / normal, 0.0, 1.0) : 0;
  const double t = vv > kTiny ? std::clamp((uv * s + vw) / vv, 0.0, 1.0) : 0;
  s = uu > kTiny ? std::clamp((uv * t - uw) / uu, 0.0, 1.0) : 0;
  return glm::distance(a + s * u, c + t * v);
}

double ArmFromSpine(const BodyPose& pose, Side side, bool sees_hand) {
  const auto [elbow, wrist, hand] = kArms[side == Side::kLeft ? 0 : 1];
  constexpr double kFromHips = 0.3, kToNeck = 0.95;
  const glm::dvec3 low = glm::mix(pose[kHipCentre], pose[kSpine], kFromHips);
  const glm::dvec3 middle = pose[kSpine];
  const glm::dvec3 high = glm::mix(middle, pose[kShoulderCentre], kToNeck);
  double nearest = SegmentDistance(pose[elbow], pose[wrist], pose[kShoulderCentre], pose[kHead]);
  nearest = std::min(nearest, SegmentDistance(pose[elbow], pose[wrist], low, middle));
  nearest = std::min(nearest, SegmentDistance(pose[elbow], pose[wrist], middle, high));
  if (!sees_hand) return nearest;
  nearest = std::min(nearest, SegmentDistance(pose[wrist], pose[hand], low, middle));
  return std::min(nearest, SegmentDistance(pose[wrist], pose[hand], middle, high));
}

void FindLimbFaults(const BodyMotion& motion, const FaultOptions& options, const std::vector<Pop>& pops,
                    std::vector<MotionFault>& faults) {
  FindStretches(motion, options, pops, faults);
  FindBends(motion, options.unseen, faults);
  FindPasses(motion, options.unseen, faults);
  FindTorn(motion, options.unseen, faults);
}

}  // namespace etude
