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

/// The errors of marks that a method assumes.
struct MarkErrors {
  double mark_error_px = 2;  ///< standard deviation of a disc in u and in v, and of a stroke's end across the stroke
  /// The standard deviation of a stroke's end along the limb, as a share of the stroke's length. Strokes are more
  /// accurate across the limb than along it *(ours)*.
  double slide_share = 0.08;
};

/// The position of a joint in a picture, from one mark.
struct MarkedJoint {
  Role role;
  glm::dvec2 pixel{0};
  glm::dmat2 information{0};  ///< inverse covariance of the pixel, 1/px²
};

/// Returns the joints that the marks of one picture show: the two ends of every stroke, and the centre of every disc. A
/// disc replaces the stroke end beneath it. All marks that end at one joint come from a single decision of the
/// annotator, so together they have the information of one mark.
std::vector<MarkedJoint> MarkedJointsOf(const Marks& marks, const MarkErrors& errors);

/// The joint positions measured from the pictures of one frame, by role. Hip centre and spine are never measured,
/// because no mark shows them.
struct JointMeasurements {
  std::array<PointMeasurement, kRoleCount> joints;
  std::array<bool, kRoleCount> is_triangulated{};  ///< true if the joint was measured from two or more pictures
};

/// Triangulates every joint from all marks that end there: the position minimises Σ rᵀ Λ r over the pictures, with r
/// the reprojection error and Λ its information (`MarkedJointsOf`), by Gauss–Newton steps from paper B's linear
/// solution. The position's information is the normal matrix of this sum at the solution. A joint that only one picture
/// shows is placed at the point of the sight line that is nearest to the joint's position in neighbouring frames, with
/// a depth error of 15 cm *(ours)*. `inputs.known` is ignored.
std::vector<JointMeasurements> MeasureJoints(const MeasureInputs& inputs, const MarkErrors& errors = {});

/// Joint positions of one frame; nullopt for a joint whose position is unknown.
using OptionalJoints = RoleVectors;

/// Fills the gaps of each joint's track: linearly between measurements, constant before the first and after the last. A
/// joint that no frame measures stays empty.
std::vector<OptionalJoints> InterpolateJoints(std::span<const JointMeasurements> measured);

/// Smooths each joint's track independently (`SmoothTrack`) with the most likely acceleration density, and fills the
/// gaps. A joint that no frame measures stays empty.
std::vector<OptionalJoints> SmoothJoints(std::span<const JointMeasurements> measured, double rate_hz);

/// Completes a body: hip centre and spine are interpolated between other joints; missing joints are attached to their
/// neighbours as in `like`, rotated about the vertical to the heading of hips and shoulders. Returns nullopt if no
/// joint has a position.
std::optional<BodyPose> CompleteJoints(const OptionalJoints& joints, const BodyPose& like);

/// Smooths the poses of a motion like `SmoothJoints`, and fills frames without a pose. Each joint is assumed to have
/// the median error of its measurements.
std::vector<BodyPose> SmoothPoses(std::span<const std::optional<BodyPose>> poses,
                                  std::span<const JointMeasurements> measured, double rate_hz);

}  // namespace etude
