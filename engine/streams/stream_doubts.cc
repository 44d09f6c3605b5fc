#include "engine/streams/stream_doubts.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "engine/retargeting/exchanged_sides.h"
#include "engine/retargeting/to_body.h"

namespace etude {
namespace {

using enum Role;

bool IsTracked(const SensedFrame& frame, Role role) { return frame[role].state == TrackingState::kTracked; }

/// Returns the poses of the frames that show all joints but toes and hands. A missing toe is placed at its ankle, and a
/// missing hand at its wrist, because FindUp needs all joints.
std::vector<BodyPose> ShownPoses(const SkeletonStream& stream) {
  constexpr std::pair<Role, Role> kTips[] = {
      {kLeftFoot, kLeftAnkle}, {kRightFoot, kRightAnkle}, {kLeftHand, kLeftWrist}, {kRightHand, kRightWrist}};
  const auto is_tip = [&](Role role) {
    return std::ranges::find(kTips, role, &std::pair<Role, Role>::first) != std::end(kTips);
  };
  std::vector<BodyPose> poses;
  for (const SensedFrame& frame : stream.frames) {
    const auto lacks = [&](Role role) { return !IsTracked(frame, role); };
    if (std::ranges::any_of(AllRoles(), [&](Role role) { return lacks(role) && !is_tip(role); })) continue;
    BodyPose& pose = poses.emplace_back(PoseOf(frame));
    for (const auto& [tip, joint] : kTips) {
      if (lacks(tip)) pose[tip] = pose[joint];
    }
  }
  return poses;
}

std::vector<JointPositions> TrackedJoints(const SkeletonStream& stream) {
  std::vector<JointPositions> tracked;
  for (const SensedFrame& frame : stream.frames) {
    JointPositions& places = tracked.emplace_back();
    for (const Role role : AllRoles()) {
      if (IsTracked(frame, role)) places[Index(role)] = frame[role].position;
    }
  }
  return tracked;
}

}  // namespace

std::optional<UpRule> StatedUp(const StreamRecording& recording, const StreamOptions& options) {
  if (!recording.is_level || options.up) return std::nullopt;
  return recording.format == StreamFormat::kTrc ? OwnJointsUp() : JointCsvUp();
}

StreamDoubts DoubtsOf(const SkeletonStream& stream, const std::optional<UpRule>& up) {
  const std::string_view backwards = LegsOf(stream).Backwards();
  const std::vector<BodyPose> poses = ShownPoses(stream);
  return {up ? FindUp(poses, stream.rate_hz, *up).doubt : "",
          DescribeExchangedJoints(TrackedJoints(stream), stream.rate_hz),
          backwards.empty() ? "" : fmt::format("{}, so the stream may be mirrored (--reflect)", backwards),
          DescribeImpossibleHeight(poses)};
}

LiveDoubts::LiveDoubts(std::optional<UpRule> up, double rate_hz)
    : up_(std::move(up)),
      shown_{.rate_hz = rate_hz, .frames = {}},
      judged_at_(static_cast<std::size_t>(std::lround(rate_hz))) {}

std::vector<std::string> LiveDoubts::Take(std::span<const SensedFrame> frames, bool at_end) {
  constexpr double kLongest_s = 32;
  std::vector<std::string> said;
  const auto longest = static_cast<std::size_t>(std::lround(kLongest_s * shown_.rate_hz));
  if (judged_at_ > longest) return said;
  // One frame without a body stands for each gap, so that no joint seems to jump across the gap.
  for (const SensedFrame& frame : frames) {
    const bool ends_body = !shown_.frames.empty() && shown_.frames.back().body_seen;
    if (frame.body_seen || ends_body) shown_.frames.push_back(frame);
  }
  if (shown_.frames.empty() || (shown_.frames.size() < judged_at_ && !at_end)) return said;
  StreamDoubts doubts = DoubtsOf(shown_, up_);
  for (std::size_t kind = 0; kind < doubts.size(); ++kind) {
    if (doubts[kind].empty() || std::exchange(is_said_[kind], true)) continue;
    said.push_back(std::move(doubts[kind]));
  }
  judged_at_ *= 2;
  if (judged_at_ > longest) shown_.frames = {};
  return said;
}

}  // namespace etude
