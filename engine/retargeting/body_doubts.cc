#include "engine/retargeting/body_doubts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/base/names.h"
#include "engine/motion/motion_faults.h"
#include "engine/retargeting/exchanged_sides.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {
namespace {

/// Returns the faults of a motion in which joints may be missing. A gap, in which the last pose is kept, is not a
/// freeze.
std::vector<MotionFault> FaultsIn(std::span<const JointPositions> frames, double rate_hz) {
  // A joint that is not seen stays where it was, or is put midway between others.
  BodyMotion body{.rate_hz = rate_hz, .poses = {}};
  std::vector<JointSet> unseen;
  for (const JointPositions& frame : frames) {
    const auto lacks = [&](Role role) { return !frame[Index(role)]; };
    if (body.poses.empty() && std::ranges::any_of(kNeededJoints, lacks)) continue;
    BodyPose pose = body.poses.empty() ? BodyPose{} : body.poses.back();
    JointSet& hidden = unseen.emplace_back();
    for (const Role role : AllRoles()) {
      if (!lacks(role)) pose[role] = *frame[Index(role)];
      hidden.set(Index(role), lacks(role));
    }
    const auto put_midway = [&](Role role, Role a, Role b) {
      if (lacks(role)) pose[role] = 0.5 * (pose[a] + pose[b]);
    };
    put_midway(Role::kHipCentre, Role::kLeftHip, Role::kRightHip);
    put_midway(Role::kShoulderCentre, Role::kLeftShoulder, Role::kRightShoulder);
    put_midway(Role::kSpine, Role::kHipCentre, Role::kShoulderCentre);
    body.poses.push_back(pose);
  }
  const double begin_s = static_cast<double>(frames.size() - body.poses.size()) / rate_hz;
  std::vector<MotionFault> faults = FindMotionFaults(body, {.begin_s = begin_s, .unseen = unseen}).faults;
  const auto is_gap = [&](const MotionFault& fault) {
    const auto frame_at = [&](double at_s) { return std::llround((at_s - begin_s) * rate_hz); };
    return fault.kind == FaultKind::kFreezes &&
           std::any_of(unseen.begin() + frame_at(fault.from_s), unseen.begin() + frame_at(fault.to_s),
                       [](const JointSet& hidden) {
                         return std::ranges::any_of(kNeededJoints, [&](Role role) { return hidden[Index(role)]; });
                       });
  };
  std::erase_if(faults, is_gap);
  return faults;
}

std::vector<std::string> SentencesOf(FaultKind kind, std::vector<MotionFault> faults) {
  std::erase_if(faults, [&](const MotionFault& fault) { return fault.kind != kind; });
  return FaultSentences(faults);
}

}  // namespace

std::string DescribeFlatBody(std::span<const JointPositions> frames) {
  constexpr double kFlat = 0.01, kMostly = 0.9;
  std::array<std::size_t, 3> flat{};
  std::size_t shown = 0;
  for (const JointPositions& frame : frames) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    const auto lacks = [&](Role role) { return !frame[Index(role)]; };
    if (std::ranges::any_of(kNeededJoints, lacks)) continue;
    for (const auto& joint : frame) {
      if (!joint) continue;
      low = glm::min(low, *joint);
      high = glm::max(high, *joint);
    }
    const glm::dvec3 extent = high - low;
    ++shown;
    for (int axis = 0; axis < 3; ++axis)
      flat[static_cast<std::size_t>(axis)] += extent[axis] < kFlat * glm::length(extent);
  }
  const auto most = static_cast<double>(*std::ranges::max_element(flat));
  if (shown == 0 || most < kMostly * static_cast<double>(shown)) return "";
  return "the body is flat, without depth: are the positions pixels of a picture? Etude reads such keypoints with "
         "`etude capture --keypoints`";
}

std::string DescribeFreezes(std::span<const JointPositions> frames, double rate_hz) {
  return Join(SentencesOf(FaultKind::kFreezes, FaultsIn(frames, rate_hz)), "; ");
}

std::vector<std::string> DoubtsOnBody(std::span<const JointPositions> frames, double rate_hz) {
  std::vector<std::string> doubts;
  if (auto said = DescribeExchangedJoints(frames, rate_hz); !said.empty()) doubts.push_back(std::move(said));
  if (auto said = DescribeFlatBody(frames); !said.empty()) doubts.push_back(std::move(said));
  // Choose torn joints, frozen frames and bent knees, which errors of single positions do not explain.
  const std::vector<MotionFault> faults = FaultsIn(frames, rate_hz);
  std::ranges::move(SentencesOf(FaultKind::kTorn, faults), std::back_inserter(doubts));
  if (auto said = Join(SentencesOf(FaultKind::kFreezes, faults), "; "); !said.empty())
    doubts.push_back(std::move(said));
  std::array<std::string, 2> bends;
  for (const MotionFault& fault : faults) {
    if (fault.kind != FaultKind::kBends) continue;
    if (std::string& first = bends[fault.joint == Role::kLeftKnee ? 0 : 1]; first.empty()) first = fault.text;
  }
  if (!bends[0].empty() && !bends[1].empty()) doubts.push_back(bends[0] + "; " + bends[1] + ": is an axis mirrored?");
  return doubts;
}

}  // namespace etude
