#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/bundle_adjustment/adjust_bundle.h"
#include "engine/bundle_adjustment/measurable_body.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/measure_joints.h"
#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/capture_body.h"
#include "engine/motion/body.h"

namespace etude {

/// Paper B's body, prepared for comparing its joints with the marks of pictures.
struct TakeBody {
  CaptureBody body;  ///< `PaperBody`
  /// The measurable body: every role that a mark shows is a point; its lengths are those of LimbLengths, in that order,
  /// both sides alike.
  MeasurableBody measurable;
  std::array<int, kRoleCount> points{};  ///< of each role its index among `measurable.points`; −1: no mark shows it
};

TakeBody MakeTakeBody(const LimbLengths& lengths);

/// `LimbLengthsOf` turns the lengths of such a body into a struct, `ListOf` a struct into the list.
LimbLengths LimbLengthsOf(std::span<const double> lengths);
std::array<double, 10> ListOf(const LimbLengths& lengths);

struct AdjustTakeInputs {
  MeasureInputs pictures;  ///< `known` is not used
  LimbLengths lengths;     ///< of the person, metres; where the search begins if they are adjusted
  /// The joints of each frame that the search begins with (`BridgeJoints`).
  std::span<const SomeJoints> start;
};

struct AdjustTakeOptions {
  MarkErrors marks;
  BundleOptions bundle;
};

struct AdjustedTake {
  bool is_solved = false;
  CaptureBody body;               ///< paper B's, with the lengths that were found
  std::vector<TreeState> states;  ///< of `body`, one per frame
};

/// Adjusts a whole take at once (`AdjustBundle`): paper B's body in every frame, seen by every mark of every picture.
/// Begins with the angles that point its limbs as the joints of `start` lie (`FindStartState`), in a frame without such
/// with its neighbour's. Not solved when no frame shows a body.
AdjustedTake AdjustTake(const AdjustTakeInputs& inputs, const AdjustTakeOptions& options = {});

/// Returns the smoothness of a motion that is filmed at this rate: hips, shoulders, wrists and ankles move smoothly,
/// and all angles.
BundleSmoothness SmoothnessOf(const TakeBody& body, double rate_hz);

struct MeasureLengthsOptions {
  /// The number of frames used, spread evenly over those that show the most joints. Errors that last over frames are
  /// averaged by frames far apart, not by more of them.
  int frames = 12;
  MarkErrors marks;
};

/// Measures the limb lengths of the person in the pictures (paper B, section 6.2.2, leaves that as future work): those
/// with which paper B's body explains the marks of a few frames best, each frame in a pose of its own (`AdjustBundle`
/// over lengths, poses and marks). Begins with the medians of the lengths between triangulated joints. Nothing when no
/// frame shows a body, or the outcome is no body.
/// @param measured the joints of every frame (`MeasureJoints`)
std::optional<LimbLengths> MeasureLengths(const MeasureInputs& pictures, std::span<const JointMeasurements> measured,
                                          const MeasureLengthsOptions& options = {});

}  // namespace etude
