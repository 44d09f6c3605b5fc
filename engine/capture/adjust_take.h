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

/// Paper B's body in the form that bundle adjustment compares with marks.
struct TakeBody {
  CaptureBody body;  ///< the body that `PaperBody` makes
  /// `body` in the form that `AdjustBundle` takes: every role that a mark can show is a point, and the lengths are the
  /// members of LimbLengths in their order, equal on the left and right sides.
  MeasurableBody measurable;
  std::array<int, kRoleCount> points{};  ///< for each role: its index in `measurable.points`, −1 if no mark shows it
};

TakeBody MakeTakeBody(const LimbLengths& lengths);

/// LimbLengthsOf and ListOf convert between LimbLengths and the list of lengths in `TakeBody::measurable`.
LimbLengths LimbLengthsOf(std::span<const double> lengths);
std::array<double, 10> ListOf(const LimbLengths& lengths);

struct AdjustTakeInputs {
  MeasureInputs pictures;  ///< cameras and marks; the member `known` is ignored
  LimbLengths lengths;     ///< lengths of the person, metres; the start of the search if lengths are adjusted
  /// For each frame, the joint positions at which the search starts (`InterpolateJoints`).
  std::span<const OptionalJoints> start;
};

struct AdjustTakeOptions {
  MarkErrors marks;
  BundleOptions bundle;
};

struct AdjustedTake {
  bool is_solved = false;
  CaptureBody body;               ///< paper B's body with the lengths of the solution
  std::vector<TreeState> states;  ///< one pose of `body` per frame
};

/// Adjusts a whole take at once (`AdjustBundle`): fits paper B's body in all frames to the marks of all pictures. The
/// search starts at the angles that point the limbs along the joints of `start` (`FindStartState`). A frame without
/// such angles starts at the pose of the last earlier frame that has them, or else of the first frame that has them.
/// `is_solved` is false if no frame shows a body.
AdjustedTake AdjustTake(const AdjustTakeInputs& inputs, const AdjustTakeOptions& options = {});

/// Returns the smoothness prior for a motion at this frame rate; it applies to hips, shoulders, wrists, ankles and all
/// angles.
BundleSmoothness SmoothnessOf(const TakeBody& body, double rate_hz);

struct MeasureLengthsOptions {
  /// The number of frames used, spread evenly over the frames that show the most joints. More frames help little: the
  /// errors of marks are similar in neighbouring frames, so only distant frames average these errors out.
  int frames = 12;
  MarkErrors marks;
};

/// Measures the limb lengths of the person in the pictures (future work in paper B, section 6.2.2): the lengths with
/// which paper B's body best explains the marks of a few frames. Each frame has an independent pose (`AdjustBundle`
/// over lengths and poses). The search starts at the medians of the distances between triangulated joints. Returns
/// nullopt if no frame shows a body or a length of the solution is not positive.
/// @param measured the joints of every frame (`MeasureJoints`)
std::optional<LimbLengths> MeasureLengths(const MeasureInputs& pictures, std::span<const JointMeasurements> measured,
                                          const MeasureLengthsOptions& options = {});

}  // namespace etude
