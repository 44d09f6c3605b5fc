#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/dlt.h"

namespace etude {

/// The pose of a calibration target T (a rigid set of known points) in the world W: p_WQ = R_WT p_TQ + p_WT.
struct CalibrationTargetPose {
  glm::dmat3 R_WT{1};
  glm::dvec3 p_WT{0};
};

/// The point pairs of a target in one picture. If points were measured in the world, all of them form one target, whose
/// frame is the world.
struct TargetView {
  std::size_t camera = 0;
  std::size_t target = 0;
  std::vector<PointPair> pairs;  ///< point pairs, in which `world` holds p_TQ, metres
};

enum class LensModel {
  kPinhole,     ///< no distortion
  kRadial2,     ///< k1, k2, p1, p2: sufficient for most lenses
  kRadial3,     ///< k1, k2, k3, p1, p2: for wide-angle lenses, if there are points in the corners of the pictures
  kAsInCamera,  ///< the distortion of the start values, held fixed
};

struct RefineOptions {
  LensModel lens = LensModel::kRadial2;
  /// Estimates the skew. Modern sensors have none, so set it only to get paper B's eleven degrees of freedom.
  bool skew = false;
  /// Holds focal lengths, principal points and lenses fixed at their start values: for rigs whose cameras were
  /// calibrated one by one and then set up.
  bool hold_intrinsics = false;
  /// Holds the cameras fixed and estimates the poses of all targets, including the first. The residuals then show how
  /// well known cameras explain the views.
  bool hold_cameras = false;
  int most_iterations = 200;
};

/// Start values of all cameras and targets.
struct RigGuess {
  std::vector<Camera> cameras;
  /// Poses of the targets; the first one is held fixed: it defines the world.
  std::vector<CalibrationTargetPose> targets;
};

/// The standard deviations of a camera's intrinsics, pixels. Each is the larger of two estimates. One assumes
/// independent corner errors of equal size; the other, made for four views or more, assumes errors that all corners of
/// a view share.
struct IntrinsicsDeviation {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

struct RefinedRig {
  std::vector<Camera> cameras;
  std::vector<CalibrationTargetPose> targets;
  /// Root mean square distance between pixels and projected points: `camera_rms_px` for each camera, `rms_px` over all.
  std::vector<double> camera_rms_px;
  double rms_px = 0;
  std::size_t points = 0;  ///< N, the number of point pairs
  /// p, the number of free parameters. If corners have errors of σ per coordinate, rms_px is near σ √(2 − p / N).
  std::size_t parameters = 0;
  /// Standard deviations of each camera's intrinsics; 0 for intrinsics that are held fixed.
  std::vector<IntrinsicsDeviation> deviations;
};

/// Finds the cameras and target poses that minimise the sum of squared reprojection errors, with distortion (method
/// "refined"; Levenberg–Marquardt by Ceres). `guess` must be near the solution: from `Calibrate`, `Decompose` or
/// planes.h. Fails if a camera has no view, if there are fewer equations than unknowns, if a camera of `guess` cannot
/// show one of the points, and if the views leave a parameter undetermined (the message names it).
Result<RefinedRig> RefineRig(const RigGuess& guess, std::span<const TargetView> views,
                             const RefineOptions& options = {});

/// Calibrates one camera from points measured in the world: `Calibrate` (normalised), `Decompose`, then `RefineRig`.
Result<RefinedRig> RefineCamera(std::span<const PointPair> pairs, int width, int height,
                                const RefineOptions& options = {});

/// Returns the root mean square distance between the pairs' pixels and the pixels at which the camera with its lens
/// shows their points; infinity if the camera cannot show one of the points.
double ReprojectionRms(const Camera& camera, const CalibrationTargetPose& target, std::span<const PointPair> pairs);

}  // namespace etude
