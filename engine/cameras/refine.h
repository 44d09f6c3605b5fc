#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/dlt.h"

namespace etude {

/// The pose of a calibration target T, rigid with known points, in the world W: p_WQ = R_WT p_TQ + p_WT.
struct TargetPlace {
  glm::dmat3 R_WT{1};
  glm::dvec3 p_WT{0};
};

/// The point pairs that one picture shows of a target. Points that were measured in the world are a target that stands
/// at the world's origin.
struct TargetView {
  std::size_t camera = 0;
  std::size_t target = 0;
  std::vector<PointPair> pairs;  ///< `world` holds p_TQ, metres
};

enum class LensModel {
  kPinhole,     ///< no distortion
  kRadial2,     ///< k1, k2, p1, p2: enough for most lenses
  kRadial3,     ///< and k3: wide angles, when pictures fill their corners
  kAsInCamera,  ///< distortion as the start has it, held
};

struct RefineOptions {
  LensModel lens = LensModel::kRadial2;
  /// Frees the skew. Sensors have had none for decades: only when paper B's eleven degrees of freedom are wanted.
  bool skew = false;
  /// Holds focal lengths, principal points and lenses as the start has them: rigs whose cameras were calibrated one by
  /// one and then set up.
  bool hold_intrinsics = false;
  /// Holds everything of the cameras and frees the first target instead: how well known cameras explain views.
  bool hold_cameras = false;
  int most_iterations = 200;
};

/// A first guess of all cameras and targets.
struct RigGuess {
  std::vector<Camera> cameras;
  std::vector<TargetPlace> targets;  ///< the first stays where it is: it is what "the world" means
};

/// The standard deviations of a camera's intrinsics, pixels, if the corners err independently and alike.
struct IntrinsicsDeviation {
  double fx = 0, fy = 0, cx = 0, cy = 0;
};

struct RefinedRig {
  std::vector<Camera> cameras;
  std::vector<TargetPlace> targets;
  /// Root mean square distance between pixels and projected points, of each camera and of all.
  std::vector<double> camera_rms_px;
  double rms_px = 0;
  std::size_t points = 0;  ///< N
  std::size_t parameters = 0;  ///< p, the free ones. With errors of σ a coordinate, rms_px is near σ √2 √((2N−p) / 2N)
  std::vector<IntrinsicsDeviation> deviations;  ///< of held cameras all 0
};

/// Finds the cameras and places of targets that make the sum of squared reprojection errors smallest (`refined`;
/// Levenberg–Marquardt by Ceres), with distortion. `guess` is near it: from `Calibrate`, `Decompose` or planes.h. Fails
/// when a camera has no view, when there are fewer equations than unknowns, when the start does not show a point, and
/// when the views leave something undetermined: it is named.
Result<RefinedRig> RefineRig(const RigGuess& guess, std::span<const TargetView> views,
                             const RefineOptions& options = {});

/// Calibrates one camera from points measured in the world: `Calibrate` (normalised), `Decompose`, then `RefineRig`.
Result<RefinedRig> RefineCamera(std::span<const PointPair> pairs, int width, int height,
                                const RefineOptions& options = {});

/// Returns the root mean square distance of the views' pixels from what the camera, with its lens, shows; infinity when
/// it does not show some point.
double ReprojectionRms(const Camera& camera, const TargetPlace& target, std::span<const PointPair> pairs);

}  // namespace etude
