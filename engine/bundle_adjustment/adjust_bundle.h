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

/// A point of the body as one picture shows it.
struct BundleMark {
  int frame = 0;
  int point = 0;  ///< index of `MeasurableBody::points`
  ProjectionMatrix matrix;
  glm::dvec2 pixel{0};
  glm::dmat2 information{1};  ///< inverse covariance of the pixel, 1/px²; symmetric, may be of rank 1
};

struct BundleInputs {
  const MeasurableBody& body;
  /// The poses that the search begins with, one per frame. Frames follow each other at one rate.
  std::span<const TreeState> start;
  std::span<const BundleMark> marks;
};

/// The loss of a mark by its distance from the projected body.
enum class RobustLoss {
  kNone,    ///< as its square: one gross error moves the whole body
  kHuber,   ///< beyond `loss_scale` as its distance
  kCauchy,  ///< beyond `loss_scale` as the distance's logarithm: hardly at all
};

/// The prior knowledge of people's motion: second differences of three frames are small.
struct BundleSmoothness {
  double rate_hz = 30;
  /// The usual acceleration of the points `points` along each axis, m/s².
  double acceleration = 8;
  std::vector<int> points;
  std::vector<double> accelerations;  ///< the usual one of each of `points` instead; none: that of all
  /// The usual acceleration of every angle, rad/s² *(ours)*; infinite: angles are not compared.
  double angle_acceleration = 40;
};

struct BundleOptions {
  RobustLoss loss = RobustLoss::kCauchy;
  /// The distance beyond which the loss flattens, in standard deviations of a mark.
  double loss_scale = 2;
  /// The smoothness that is asked for; absent when frames do not follow each other.
  std::optional<BundleSmoothness> smoothness;
  /// The standard deviation of how far an angle lies beyond its limit, radians: limits are those of people in general
  /// *(ours)*.
  double limit_deviation = Radians(3);
  bool adjusts_lengths = false;
  /// A take settles within some ten iterations; later ones move only along directions that no mark determines.
  int max_iterations = 25;
  /// The search ends when a step lowers the cost by a smaller part than this.
  double smallest_decrease = 1e-4;
};

struct BundleSolution {
  bool is_solved = false;  ///< false: the start could not be judged, and is what stands below
  std::vector<TreeState> states;
  std::vector<double> lengths;  ///< metres
  double first_cost = 0, last_cost = 0;
  int iterations = 0;
};

/// Bundle adjustment: the poses of all frames, and the body's lengths if they may change, that minimise
///   Σ_marks ρ(rᵀ Λ r) + Σ_frames |second difference of points and angles|² / σ² + Σ |angle beyond its limit|² / σ²,
/// r the reprojection error of a mark in pixels, Λ its information, ρ the robust loss. By Ceres's Levenberg–Marquardt
/// with an analytic Jacobian and a sparse Cholesky factor: time grows with the number of frames, not with a power of
/// it. What no mark and no neighbour tells stays as in `start`. Marks of a point that `start` has behind the camera are
/// left out.
BundleSolution AdjustBundle(const BundleInputs& inputs, const BundleOptions& options = {});

}  // namespace etude
