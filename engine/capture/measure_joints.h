#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/capture/mark_errors.h"
#include "engine/capture/measure_frames.h"
#include "engine/motion/body.h"
#include "engine/smoothing/track_smoother.h"

namespace etude {

/// What one frame's pictures say of each joint, by role; nothing of hip centre and spine, which no mark shows.
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

/// A place for some joints.
using SomeJoints = RoleVectors;

/// The joints of each frame, straight from one measured place to the next where a frame shows nothing of a joint, held
/// before the first and after the last one. A joint that no frame measures has no place.
std::vector<SomeJoints> BridgeJoints(std::span<const JointMeasurements> measured);

/// Smooths each joint's track by itself (`SmoothTrack`), with the motion under which its measurements are likeliest;
/// fills what frames do not show. A joint that no frame measures has no place.
std::vector<SomeJoints> SmoothJoints(std::span<const JointMeasurements> measured, double rate_hz);

/// A whole body: hip centre and spine lie between the others; joints without a place hang from their neighbours as in
/// `like`, turned about the vertical as the hips or shoulders are. Nothing when no joint has a place.
std::optional<BodyPose> CompleteJoints(const SomeJoints& joints, const BodyPose& like);

/// The poses of a motion smoothed likewise, frames without one filled. Each joint errs as its measurements say.
std::vector<BodyPose> SmoothPoses(std::span<const std::optional<BodyPose>> poses,
                                  std::span<const JointMeasurements> measured, double rate_hz);

}  // namespace etude
