#include "engine/retargeting/body_doubts.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <utility>

#include "engine/motion/motion_faults.h"
#include "engine/retargeting/exchanged_sides.h"
#include "engine/retargeting/marker_sets.h"

namespace etude {
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

std::vector<std::string> DoubtsOnBody(std::span<const JointPositions> frames, double rate_hz) {
  std::vector<std::string> doubts;
  if (auto said = DescribeExchangedJoints(frames, rate_hz); !said.empty()) doubts.push_back(std::move(said));
  if (auto said = DescribeFlatBody(frames); !said.empty()) doubts.push_back(std::move(said));
  // Make a body. A joint that is not seen stays where it was, or is put midway between others.
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
  // Choose torn joints and bent knees, which errors of single positions do not explain.
  std::vector<MotionFault> torn;
  std::array<std::string, 2> bends;
  const double begin_s = static_cast<double>(frames.size() - body.poses.size()) / rate_hz;
  const MotionFaults found = FindMotionFaults(body, {.begin_s = begin_s, .unseen = std::move(unseen)});
  for (const MotionFault& fault : found.faults) {
    if (fault.kind == FaultKind::kTorn) torn.push_back(fault);
    if (fault.kind != FaultKind::kBends) continue;
    if (std::string& first = bends[fault.joint == Role::kLeftKnee ? 0 : 1]; first.empty()) first = fault.text;
  }
  std::ranges::move(FaultSentences(torn), std::back_inserter(doubts));
  if (!bends[0].empty() && !bends[1].empty()) doubts.push_back(bends[0] + "; " + bends[1] + ": is an axis mirrored?");
  return doubts;
}

}  // namespace etude
