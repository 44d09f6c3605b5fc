#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/bundle_adjustment/adjust_bundle.h"
#include "engine/capture/measure_frames.h"
#include "engine/capture/measure_joints.h"
#include "engine/capture/take_body.h"

namespace etude {

struct AdjustTakeInputs {
  MeasureInputs pictures;  ///< `known` is not used
  LimbLengths lengths;     ///< of the person, metres; where the search begins if they are adjusted
  /// Where the search begins: of each frame the place of joints (`BridgeJoints`).
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

/// Bundle adjustment of a whole take (`AdjustBundle`): paper B's body in every frame, seen by every mark of every
/// picture. Begins with the angles that point its limbs as the joints of `start` lie (`FindStartState`), in a frame
/// without such with its neighbour's. Not solved when no frame shows a body.
AdjustedTake AdjustTake(const AdjustTakeInputs& inputs, const AdjustTakeOptions& options = {});

/// Of a motion that is filmed at this rate: hips, shoulders, wrists and ankles move smoothly, and all angles.
BundleSmoothness SmoothnessOf(const TakeBody& body, double rate_hz);

}  // namespace etude
