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

/// Two successive frames of one motion; the difference of the two gives the velocity.
struct PosePair {
  BodyPose before;
  BodyPose now;
};

/// The input of a join at a transition point. All poses are in the frame of the spliced motion.
struct JoinInput {
  PosePair shown;   ///< the last two frames shown
  PosePair target;  ///< the new motion's frames at the same times
  /// Returns the old motion's next `count` frames, or fewer at its end. Call it only in JoinKind::begin.
  std::function<std::vector<BodyPose>(std::size_t count)> continuation;
  /// Returns the new motion's next `count` frames after the point, or fewer at its end. Call it only in
  /// JoinKind::begin.
  std::function<std::vector<BodyPose>(std::size_t count)> upcoming = {};
  /// The choice's preferred join, which minimum-jerk and planted-feet use.
  std::optional<PreferredJoin> preferred = {};
  double rate_hz = kJudgedRateHz;
};

/// Returns the pose to show `frames` ≥ 1 after the transition point; `target` is the new motion's frame at that time.
using Blend = std::function<BodyPose(const BodyPose& target, int frames)>;

/// The length of motion after the point over which `JoinKind::align` aligns the clips, in seconds.
constexpr double kAlignedSeconds = 0.5;

/// A kind of join, which connects two clips at a transition point. Scenario files use its name. Every join keeps the
/// lengths of limbs.
struct JoinKind {
  std::string name;
  std::string description;  ///< one line for users
  std::vector<NumberSetting> settings = {};
  /// Begins a join. `values` has one value per setting, in order; if empty, the defaults apply.
  Blend (*begin)(const JoinInput& input, std::span<const double> values) = nullptr;
  /// Returns the floor move that aligns the new motion with the old one. Both spans contain the frames from the point
  /// on, at least one frame. If `align` is null, AlignOnFloor aligns the two frames of the point.
  FloorMove (*align)(std::span<const BodyPose> old, std::span<const BodyPose> next, double rate_hz) = nullptr;
};

/// Returns all joins, paper A's cut first.
std::span<const JoinKind> AllJoins();
std::vector<std::string> JoinNames();
/// Returns the join called `name`, or null if there is none.
const JoinKind* FindJoin(std::string_view name);

}  // namespace etude
