#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/settings.h"
#include "engine/motion/body.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// Two successive frames: a body's pose and, by difference, its velocity.
struct PosePair {
  BodyPose before;
  BodyPose now;
};

/// The input of a join at a transition point, all in the place where it is shown.
struct JoinInput {
  PosePair shown;   ///< the last two frames shown
  PosePair target;  ///< the new motion's frames that would stand in their place
  /// Returns the old motion's next `count` frames, fewer where it ends. It may be called only while the join begins.
  std::function<std::vector<BodyPose>(std::size_t count)> continuation;
  /// Returns the new motion's next `count` frames after its frame at the point, under the same conditions.
  std::function<std::vector<BodyPose>(std::size_t count)> upcoming = {};
  std::optional<PreferredJoin> preferred = {};  ///< of the choice of frames; minimum-jerk and planted-feet follow it
  double rate_hz = kJudgedRateHz;
};

/// The frame to show, `frames` (≥ 1) after the transition point, from the new motion's frame there.
using Blend = std::function<BodyPose(const BodyPose& target, int frames)>;

/// The length of motion after the point by which a join is aligned, seconds.
constexpr double kAlignedSeconds = 0.5;

/// A way to put two clips together at a transition point, by the name scenario files call it. All limbs keep their
/// lengths.
struct JoinKind {
  std::string name;
  std::string description;  ///< one line, for people
  std::vector<NumberSetting> settings = {};
  /// `values`: one per setting, in their order; none at all: the defaults.
  Blend (*begin)(const JoinInput& input, std::span<const double> values) = nullptr;
  /// The move on the floor that lays the new motion onto the old one, from frames of both from the point on, one at
  /// least each. Null: AlignOnFloor of the two frames of the point.
  FloorMove (*align)(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz) = nullptr;
};

/// Lists all joins, paper A's cut first.
std::span<const JoinKind> AllJoins();
std::vector<std::string> JoinNames();
/// Returns the join of that name, null when there is none.
const JoinKind* FindJoin(std::string_view name);

}  // namespace etude
