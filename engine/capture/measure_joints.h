#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/capture/measure_frames.h"
#include "engine/motion/body.h"
#include "engine/smoothing/track_smoother.h"
#include "engine/vision/strokes.h"

namespace etude {

/// The accuracy of marks, as far as a method may know it.
struct MarkErrors {
  double mark_error_px = 2;  ///< standard deviation of a stroke's end across the stroke, and of a disc, in u and in v
  /// The standard deviation of a stroke's end along the limb, as a share of the stroke's length: a stroke says more
  /// surely on which line a limb lies than where it begins *(ours)*.
  double slide_share = 0.08;
};

/// A joint's place in a picture as one mark shows it.
struct MarkedJoint {
  Role role;
  glm::dvec2 pixel{0};
  glm::dmat2 information{0};  ///< inverse covariance, 1/px²
};

/// Returns the joints that the marks of one picture show: both ends of every stroke, and the tip of every disc, which
/// covers the stroke's end there. A joint that several marks end at was found once, by one hand: they share the
/// information of one.
std::vector<MarkedJoint> MarkedJointsOf(const Marks& marks, const MarkErrors& errors);

/// The places of joints measured from one frame's pictures, by role; hip centre and spine have none, for no mark shows
/// them.
struct JointMeasurements {
  std::array<PointMeasurement, kRoleCount> joints;
  std::array<bool, kRoleCount> is_triangulated{};  ///< from two pictures or more
};

/// Triangulates every joint from all marks that end there: the place of least Σ rᵀ Λ r over the pictures, r the
/// reprojection error and Λ its information (`MarkedJointsOf`), by Gauss–Newton steps from paper B's linear solution;
/// its information is the one of the sum there. A joint that one picture alone shows lies at that point of
/// the line of sight which is nearest to where neighbouring frames have it; how far away it is, is known to 15 cm
/// *(ours)*.
/// `inputs.known` is not used.
std::vector<JointMeasurements> MeasureJoints(const MeasureInputs& inputs, const MarkErrors& errors = {});

/// The places of those joints that have one.
using SomeJoints = RoleVectors;

/// Fills the gaps of each joint's track: straight from one measured place to the next, held before the first and after
/// the last one. A joint that no frame measures has no place.
std::vector<SomeJoints> BridgeJoints(std::span<const JointMeasurements> measured);

/// Smooths each joint's track by itself (`SmoothTrack`), with the motion under which its measurements are likeliest;
/// fills what frames do not show. A joint that no frame measures has no place.
std::vector<SomeJoints> SmoothJoints(std::span<const JointMeasurements> measured, double rate_hz);

/// Completes a body: hip centre and spine lie between the others; joints without a place hang from their neighbours as
/// in `like`, turned about the vertical as the hips or shoulders are. Nothing when no joint has a place.
std::optional<BodyPose> CompleteJoints(const SomeJoints& joints, const BodyPose& like);

/// Smooths the poses of a motion as `SmoothJoints` does and fills frames without one. Each joint errs as its
/// measurements say.
std::vector<BodyPose> SmoothPoses(std::span<const std::optional<BodyPose>> poses,
                                  std::span<const JointMeasurements> measured, double rate_hz);

}  // namespace etude
