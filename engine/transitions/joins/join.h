#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/motion/body.h"
#include "engine/transitions/base/transition_record.h"

namespace etude {

/// Two successive frames: where a body is, and, by difference, how it moves.
struct PosePair {
  BodyPose before;
  BodyPose now;
};

/// What a join knows of a transition point, all in the place where it is shown.
struct JoinInput {
  PosePair shown;   ///< the last two frames shown
  PosePair target;  ///< the new motion's frames that would stand in their place
  /// What the old motion would have shown next: so many frames, fewer where it ends. To be asked only while the join
  /// begins.
  std::function<std::vector<BodyPose>(std::size_t count)> continuation;
  /// What the new motion has next after its frame at the point, likewise.
  std::function<std::vector<BodyPose>(std::size_t count)> upcoming = {};
  std::optional<PreferredJoin> preferred = {};  ///< of the choice of frames; minimum-jerk and planted-feet follow it
  double rate_hz = kJudgedRateHz;
};

/// The frame to show, `frames` (≥ 1) after the transition point, from the new motion's frame there.
using Blend = std::function<BodyPose(const BodyPose& target, int frames)>;

/// How much motion after the point a join is aligned by, seconds.
constexpr double kAlignedSeconds = 0.5;

/// A way to put two clips together at a transition point, by the name scenario files call it. All limbs keep their
/// lengths.
struct Join {
  std::string name;
  std::string description;  ///< one line, for people
  std::vector<NumberSetting> settings = {};
  /// `values`: one per setting, in their order; none at all: the defaults.
  Blend (*begin)(const JoinInput& input, std::span<const double> values) = nullptr;
  /// The move on the floor that lays the new motion onto the old one, from frames of both from the point on, one at
  /// least each. Null: AlignOnFloor of the two frames of the point.
  FloorMove (*align)(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz) = nullptr;
};

/// Paper A's cut first.
std::span<const Join> AllJoins();
std::vector<std::string> JoinNames();
/// Null when there is no such join.
const Join* FindJoin(std::string_view name);

}  // namespace etude
