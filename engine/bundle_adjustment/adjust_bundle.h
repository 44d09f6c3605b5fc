#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/bundle_adjustment/measurable_body.h"
#include "engine/cameras/camera.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// One observation: a point of the body in one picture.
struct BundleMark {
  int frame = 0;
  int point = 0;  ///< index in `MeasurableBody::points`
  ProjectionMatrix matrix;
  glm::dvec2 pixel{0};
  glm::dmat2 information{1};  ///< inverse covariance of the pixel, 1/px²; symmetric, may be of rank 1
};

struct BundleInputs {
  const MeasurableBody& body;
  /// Start poses, one per frame. With a smoothness prior, the frames must be consecutive and at a constant rate.
  std::span<const TreeState> start;
  std::span<const BundleMark> marks;
};

/// The loss function ρ of a mark's reprojection error.
enum class RobustLoss {
  kNone,    ///< quadratic: a single gross error moves the whole body
  kHuber,   ///< linear beyond `loss_scale`
  kCauchy,  ///< logarithmic beyond `loss_scale`: gross errors have hardly any influence
};

/// The smoothness prior: second differences of points and of angles over three frames are small.
struct BundleSmoothness {
  double rate_hz = 30;
  /// The standard deviation of the acceleration of `points` along each axis, m/s².
  double acceleration = 8;
  std::vector<int> points;
  std::vector<double> accelerations;  ///< standard deviation for each of `points`, m/s²; empty: `acceleration` applies
  /// The standard deviation of the acceleration of every angle, rad/s² *(ours)*; infinity turns this term off.
  double angle_acceleration = 40;
};

struct BundleOptions {
  RobustLoss loss = RobustLoss::kCauchy;
  /// The reprojection error beyond which the loss flattens, in standard deviations of the mark's pixel.
  double loss_scale = 2;
  /// The smoothness prior; empty if frames are not consecutive.
  std::optional<BundleSmoothness> smoothness;
  /// The standard deviation of the amount by which an angle exceeds its limit, radians. Limits are soft because they
  /// describe average people *(ours)*.
  double limit_deviation = Radians(3);
  bool adjusts_lengths = false;
  /// Maximum number of iterations. A take converges in about ten; later iterations only move along directions that no
  /// mark determines.
  int max_iterations = 25;
  /// The search ends if a step lowers the cost by less than this fraction of the cost.
  double min_decrease = 1e-4;
};

struct BundleSolution {
  bool is_solved = false;  ///< false if the cost at the start could not be evaluated; the solution is then the start
  std::vector<TreeState> states;
  std::vector<double> lengths;  ///< lengths of the body, metres
  double first_cost = 0, last_cost = 0;
  int iterations = 0;
};

/// Adjusts the poses of all frames, and the body's lengths if `adjusts_lengths`, by bundle adjustment. Minimises
///   Σ_marks ρ(rᵀ Λ r) + Σ_frames |second difference of points and angles|² / σ² + Σ |angle beyond its limit|² / σ²
/// by Ceres's Levenberg–Marquardt method with an analytic Jacobian and a sparse Cholesky factor. Here r is the
/// reprojection error of a mark in pixels, Λ its information, and ρ the robust loss. Time is linear in the number of
/// frames. Angles that are determined neither by marks nor by neighbouring frames stay as in `start`. Marks of a point
/// that at `start` is behind the camera, or less than 0.1 m in front of it, are ignored.
BundleSolution AdjustBundle(const BundleInputs& inputs, const BundleOptions& options = {});

}  // namespace etude
