#include "engine/bundle_adjustment/adjust_bundle.h"

#include <ceres/cost_function.h>
#include <ceres/evaluation_callback.h>
#include <ceres/loss_function.h>
#include <ceres/manifold.h>
#include <ceres/problem.h>
#include <ceres/solver.h>
#include <glog/logging.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <memory>

#include "engine/bundle_adjustment/frame_variables.h"

namespace etude {
namespace {

/// The manifold of Ceres's QuaternionManifold, but with a `Plus` written here, because Ceres's `Plus` rounds
/// differently from version to version (2.2 uses hypot instead of sqrt), and an adjustment of only a few steps
/// magnifies the difference.
class TurnManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return kTurnSize; }
  int TangentSize() const override { return kTurnSize - 1; }

  /// Rotates the quaternion q by twice the tangent d: q ↦ (cos|d|, sin|d| d/|d|) q.
  bool Plus(const double* q, const double* d, double* turned) const override {
    const double norm = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double scale = norm > 0 ? std::sin(norm) / norm : 1.0;
    const double w = std::cos(norm), x = scale * d[0], y = scale * d[1], z = scale * d[2];
    turned[0] = w * q[0] - x * q[1] - y * q[2] - z * q[3];
    turned[1] = w * q[1] + x * q[0] + y * q[3] - z * q[2];
    turned[2] = w * q[2] - x * q[3] + y * q[0] + z * q[1];
    turned[3] = w * q[3] + x * q[2] - y * q[1] + z * q[0];
    return true;
  }
  bool PlusJacobian(const double* q, double* jacobian) const override { return ceres_.PlusJacobian(q, jacobian); }
  bool Minus(const double* to, const double* from, double* d) const override { return ceres_.Minus(to, from, d); }
  bool MinusJacobian(const double* q, double* jacobian) const override { return ceres_.MinusJacobian(q, jacobian); }

 private:
  ceres::QuaternionManifold ceres_;
};

/// All parameter blocks of the problem.
struct Variables {
  MeasurableBody body;  // the body with the lengths of the last evaluation
  std::vector<double> lengths;
  std::vector<FrameVariables> frames;
};

/// Computes the body's points in every frame once before each evaluation, because many residuals share the points of a
/// frame.
class PlaceEveryFrame final : public ceres::EvaluationCallback {
 public:
  explicit PlaceEveryFrame(Variables& variables) : variables_(variables) {}

  void PrepareForEvaluation(bool wants_jacobians, bool) override {
    if (variables_.lengths != variables_.body.lengths) {
      variables_.body = WithLengths(variables_.body, variables_.lengths);
    }
    for (FrameVariables& frame : variables_.frames) {
      PlacePoints(variables_.body, frame.State(), wants_jacobians, frame.placed);
    }
  }

 private:
  Variables& variables_;
};

void ClearJacobians(const ceres::CostFunction& cost, double** jacobians) {
  const auto& sizes = cost.parameter_block_sizes();
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    if (jacobians[i] != nullptr) std::fill_n(jacobians[i], sizes[i] * cost.num_residuals(), 0.0);
  }
}

// Returns the homogeneous pixel H (p, 1).
glm::dvec3 Homogeneous(const ProjectionMatrix& matrix, const glm::dvec3& p) {
  glm::dvec3 uvw;
  for (int k = 0; k < 3; ++k) {
    const auto& h = matrix.h[k];
    uvw[k] = h[0] * p.x + h[1] * p.y + h[2] * p.z + h[3];
  }
  return uvw;
}

/// Returns the two rows of the upper Cholesky factor W of an information matrix Λ, WᵀW = Λ. W also exists if Λ has rank
/// 1.
std::array<glm::dvec2, 2> RootOf(const glm::dmat2& information) {
  const double a = std::sqrt(std::max(0.0, information[0][0]));
  const double b = a > 0 ? information[1][0] / a : 0;
  const double c = std::sqrt(std::max(0.0, information[1][1] - b * b));
  return {glm::dvec2(a, b), glm::dvec2(0, c)};
}

/// The reprojection error of one mark in standard deviations. Parameter blocks: position, rotation, angles; lengths if
/// adjusted.
class MarkCost final : public ceres::CostFunction {
 public:
  MarkCost(const BundleMark& mark, const Variables& variables, bool adjusts_lengths)
      : mark_(mark),
        root_(RootOf(mark.information)),
        frame_(variables.frames[mark.frame]),
        length_block_(adjusts_lengths ? 3 : -1) {
    set_num_residuals(2);
    *mutable_parameter_block_sizes() = {kPositionSize, kTurnSize, static_cast<int>(frame_.angles.size())};
    if (adjusts_lengths) mutable_parameter_block_sizes()->push_back(static_cast<int>(variables.lengths.size()));
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    const glm::dvec3 uvw = Homogeneous(mark_.matrix, frame_.placed.positions[mark_.point]);
    constexpr double kMinDepthM = 1e-3;
    if (!(uvw.z > kMinDepthM)) return false;
    const glm::dvec2 pixel(uvw.x / uvw.z, uvw.y / uvw.z), error = pixel - mark_.pixel;
    for (int k = 0; k < 2; ++k) residuals[k] = glm::dot(root_[k], error);
    if (jacobians == nullptr) return true;
    ClearJacobians(*this, jacobians);
    // Compute the derivatives of the pixel with respect to the point.
    const auto& h = mark_.matrix.h;
    const auto row_of = [&](int k) {
      const auto gain = [&](int axis) { return (h[k][axis] - pixel[k] * h[2][axis]) / uvw.z; };
      return glm::dvec3(gain(0), gain(1), gain(2));
    };
    const glm::dvec3 du = row_of(0), dv = row_of(1);
    const PointGains gains(frame_, mark_.point, jacobians, 0, length_block_);
    for (int k = 0; k < 2; ++k) gains.Add(k, root_[k].x * du + root_[k].y * dv);
    return true;
  }

 private:
  const BundleMark& mark_;
  const std::array<glm::dvec2, 2> root_;
  const FrameVariables& frame_;
  const int length_block_;
};

constexpr std::array<double, 3> kSecondDifference = {1, -2, 1};

/// The second difference of each of `points` over three frames, in standard deviations. Parameter blocks: position,
/// rotation, angles of each frame; lengths if adjusted.
class PointAcceleration final : public ceres::CostFunction {
 public:
  PointAcceleration(const FrameVariables* first, std::span<const int> points, std::span<const double> deviation,
                    int lengths)
      : frames_{first, first + 1, first + 2},
        points_(points),
        deviations_(deviation),
        length_block_(lengths > 0 ? 9 : -1) {
    set_num_residuals(3 * static_cast<int>(points.size()));
    for (int i = 0; i < 3; ++i) {
      for (const int size : {kPositionSize, kTurnSize, static_cast<int>(first->angles.size())}) {
        mutable_parameter_block_sizes()->push_back(size);
      }
    }
    if (lengths > 0) mutable_parameter_block_sizes()->push_back(lengths);
  }

  bool Evaluate(double const* const*, double* residuals, double** jacobians) const override {
    if (jacobians != nullptr) ClearJacobians(*this, jacobians);
    for (int row = 0; row < num_residuals(); ++row) residuals[row] = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      for (int f = 0; f < 3; ++f) {
        // Each of the three frames contributes one term of the second difference.
        const double share = kSecondDifference[f] / deviations_[i];
        const glm::dvec3& p = frames_[f]->placed.positions[points_[i]];
        for (int k = 0; k < 3; ++k) residuals[3 * i + k] += share * p[k];
        if (jacobians == nullptr) continue;
        const PointGains gains(*frames_[f], points_[i], jacobians, 3 * f, length_block_);
        for (int k = 0; k < 3; ++k) {
          glm::dvec3 along(0);
          along[k] = share;
          gains.Add(3 * static_cast<int>(i) + k, along);
        }
      }
    }
    return true;
  }

 private:
  const std::array<const FrameVariables*, 3> frames_;
  const std::span<const int> points_;
  const std::span<const double> deviations_;
  const int length_block_;
};

/// The second difference of all angles over three frames, in standard deviations. Parameter blocks: angles of each
/// frame.
class AngleAcceleration final : public ceres::CostFunction {
 public:
  AngleAcceleration(int angles, double deviation) : angles_(angles), deviation_(deviation) {
    set_num_residuals(angles);
    *mutable_parameter_block_sizes() = {angles, angles, angles};
  }

  bool Evaluate(double const* const* q, double* residuals, double** jacobians) const override {
    for (int k = 0; k < angles_; ++k) residuals[k] = (q[0][k] - 2 * q[1][k] + q[2][k]) / deviation_;
    if (jacobians == nullptr) return true;
    ClearJacobians(*this, jacobians);
    for (int f = 0; f < 3; ++f) {
      for (int k = 0; jacobians[f] != nullptr && k < angles_; ++k) {
        jacobians[f][k * angles_ + k] = kSecondDifference[f] / deviation_;
      }
    }
    return true;
  }

 private:
  const int angles_;
  const double deviation_;
};

/// The amounts by which angles exceed their limits, in standard deviations. Parameter block: angles of the frame.
class LimitViolation final : public ceres::CostFunction {
 public:
  LimitViolation(std::span<const AngleRange> limits, double deviation) : limits_(limits), deviation_(deviation) {
    set_num_residuals(static_cast<int>(limits.size()));
    *mutable_parameter_block_sizes() = {static_cast<int>(limits.size())};
  }

  bool Evaluate(double const* const* q, double* residuals, double** jacobians) const override {
    if (jacobians != nullptr) ClearJacobians(*this, jacobians);
    for (std::size_t k = 0; k < limits_.size(); ++k) {
      const double beyond = q[0][k] - std::clamp(q[0][k], limits_[k].lower, limits_[k].upper);
      residuals[k] = beyond / deviation_;
      if (jacobians != nullptr && jacobians[0] != nullptr && beyond != 0) {
        jacobians[0][k * limits_.size() + k] = 1 / deviation_;
      }
    }
    return true;
  }

 private:
  const std::span<const AngleRange> limits_;
  const double deviation_;
};

std::unique_ptr<ceres::LossFunction> MakeLoss(const BundleOptions& options) {
  switch (options.loss) {
    case RobustLoss::kHuber:
      return std::make_unique<ceres::HuberLoss>(options.loss_scale);
    case RobustLoss::kCauchy:
      return std::make_unique<ceres::CauchyLoss>(options.loss_scale);
    case RobustLoss::kNone:
      break;
  }
  return nullptr;
}

/// The cost of the adjustment as a Ceres problem. This object owns the cost's terms; the Ceres problem only refers to
/// them.
class BundleProblem {
 public:
  BundleProblem(const BundleInputs& inputs, const BundleOptions& options, Variables& variables)
      : options_(options),
        variables_(variables),
        loss_(MakeLoss(options)),
        place_(variables),
        problem_(Borrow(place_)) {
    // Add the rotation manifolds, then the terms of the marks, of the angle limits and of the smoothness prior.
    for (FrameVariables& frame : variables_.frames) {
      problem_.AddParameterBlock(frame.turn.data(), kTurnSize, &turn_manifold_);
    }
    for (const BundleMark& mark : inputs.marks) AddMark(mark);
    for (FrameVariables& frame : variables_.frames) {
      Add<LimitViolation>({frame.angles.data()}, inputs.body.tree.limits, options_.limit_deviation);
    }
    if (options_.smoothness) AddSmoothness(*options_.smoothness);
  }

  ceres::Problem& problem() { return problem_; }

 private:
  static ceres::Problem::Options Borrow(PlaceEveryFrame& place) {
    ceres::Problem::Options borrow;
    borrow.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    borrow.loss_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    borrow.manifold_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    borrow.evaluation_callback = &place;
    return borrow;
  }

  template <typename Cost, typename... Arguments>
  void Add(const std::vector<double*>& blocks, const Arguments&... arguments) {
    costs_.push_back(std::make_unique<Cost>(arguments...));
    problem_.AddResidualBlock(costs_.back().get(), nullptr, blocks);
  }

  std::vector<double*> BlocksOf(std::span<FrameVariables> frames) {
    std::vector<double*> blocks;
    for (FrameVariables& frame : frames) {
      blocks.insert(blocks.end(), {frame.position.data(), frame.turn.data(), frame.angles.data()});
    }
    if (options_.adjusts_lengths) blocks.push_back(variables_.lengths.data());
    return blocks;
  }

  void AddMark(const BundleMark& mark) {
    FrameVariables& frame = variables_.frames[mark.frame];
    PlacePoints(variables_.body, frame.State(), false, frame.placed);
    constexpr double kMinDepthM = 0.1;
    if (!(Homogeneous(mark.matrix, frame.placed.positions[mark.point]).z > kMinDepthM)) return;
    costs_.push_back(std::make_unique<MarkCost>(mark, variables_, options_.adjusts_lengths));
    problem_.AddResidualBlock(costs_.back().get(), loss_.get(), BlocksOf({&frame, 1}));
  }

  void AddSmoothness(const BundleSmoothness& smoothness) {
    const double per_frame = 1 / (smoothness.rate_hz * smoothness.rate_hz);
    const int lengths = options_.adjusts_lengths ? static_cast<int>(variables_.lengths.size()) : 0;
    deviations_ = smoothness.accelerations;
    deviations_.resize(smoothness.points.size(), smoothness.acceleration);
    for (double& deviation : deviations_) deviation *= per_frame;
    for (std::size_t k = 0; k + 2 < variables_.frames.size(); ++k) {
      FrameVariables* first = &variables_.frames[k];
      Add<PointAcceleration>(BlocksOf({first, 3}), first, smoothness.points, deviations_, lengths);
      if (std::isinf(smoothness.angle_acceleration)) continue;
      Add<AngleAcceleration>({first[0].angles.data(), first[1].angles.data(), first[2].angles.data()},
                             variables_.body.tree.dof_count(), per_frame * smoothness.angle_acceleration);
    }
  }

  const BundleOptions& options_;
  Variables& variables_;
  const std::unique_ptr<ceres::LossFunction> loss_;
  TurnManifold turn_manifold_;
  std::vector<double> deviations_;  ///< standard deviation of the second difference of each smooth point, metres
  std::vector<std::unique_ptr<ceres::CostFunction>> costs_;
  PlaceEveryFrame place_;
  ceres::Problem problem_;
};

ceres::Solver::Options SolverOptions(const BundleOptions& options) {
  ceres::Solver::Options solver;
  solver.trust_region_strategy_type = ceres::LEVENBERG_MARQUARDT;
  // Eigen's sparse Cholesky is scalar code, so results do not depend on a BLAS library or on cache sizes.
  solver.linear_solver_type = ceres::SPARSE_NORMAL_CHOLESKY;
  solver.sparse_linear_algebra_library_type = ceres::EIGEN_SPARSE;
  solver.max_num_iterations = options.max_iterations;
  solver.function_tolerance = options.min_decrease;
  solver.gradient_tolerance = 0;
  solver.parameter_tolerance = 0;
  solver.max_solver_time_in_seconds = std::numeric_limits<double>::max();
  solver.num_threads = 1;
  solver.logging_type = ceres::SILENT;
  return solver;
}

}  // namespace

BundleSolution AdjustBundle(const BundleInputs& inputs, const BundleOptions& options) {
  FLAGS_minloglevel = google::GLOG_FATAL;  // no log output: the summary reports the outcome
  // Set the parameter blocks to the start poses.
  Variables variables{inputs.body, inputs.body.lengths, {}};
  for (const TreeState& state : inputs.start) {
    assert(state.angles.size() == inputs.body.tree.limits.size());
    variables.frames.emplace_back(state);
  }
  // If Ceres finds no usable solution, return the start poses.
  BundleSolution solution;
  solution.lengths = inputs.body.lengths;
  solution.states.assign(inputs.start.begin(), inputs.start.end());
  if (variables.frames.empty()) return solution;
  BundleProblem sum(inputs, options, variables);
  ceres::Solver::Summary summary;
  ceres::Solve(SolverOptions(options), &sum.problem(), &summary);
  if (!summary.IsSolutionUsable()) return solution;
  solution.is_solved = true;
  solution.first_cost = summary.initial_cost;
  solution.last_cost = summary.final_cost;
  solution.iterations = static_cast<int>(summary.iterations.size()) - 1;
  solution.lengths = variables.lengths;
  for (std::size_t i = 0; i < variables.frames.size(); ++i) solution.states[i] = variables.frames[i].State();
  return solution;
}

}  // namespace etude
