#include "engine/silhouettes/fit_silhouettes.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <utility>

#include "engine/silhouettes/silhouette_cost.h"
#include "engine/silhouettes/turns.h"

namespace etude {
namespace {

// The derivatives of a capsule's two projected ends: rows are the six numbers δ of SilhouetteResidual, columns are the
// coordinates that move the capsule's limb.
struct CapsuleMotion {
  static constexpr std::size_t kMaxCount = 32;
  std::size_t count = 0;
  std::array<int, kMaxCount> coordinates;
  std::array<std::array<double, kMaxCount>, 6> rows;
};

// For one seen joint: the offset of its projection from the pixel where it was seen, the loss (Geman and McClure), and
// the weight of the squared offset in a step. All three numbers are 0 for a joint behind the camera.
struct JointError {
  glm::dvec2 off{0};
  double loss = 0, weight = 0;
};

JointError JointErrorOf(const SeenJoint& seen, const SilhouetteBody& body, const TreeFrames& frames,
                        const PixelScale& camera, const SilhouetteCostOptions& options) {
  constexpr double kNearest = 0.05;  // minimum distance in front of the camera, metres
  const glm::dvec3 p_WQ = PlaceOf(body.roles[Index(seen.role)], frames);
  if (camera.DepthOf(p_WQ) < kNearest) return {};
  JointError error{.off = camera.PixelOf(p_WQ) - seen.pixel};
  const double variance = seen.sigma_px * seen.sigma_px, squares = glm::dot(error.off, error.off) / variance;
  const double far = 1 + squares / (options.joint_reach * options.joint_reach);
  error.loss = squares / far;
  error.weight = 1 / (far * far * variance);
  return error;
}

class Linearisation {
 public:
  Linearisation(const SilhouetteBody& body, int size)
      : body_(body), gradient_(Eigen::VectorXd::Zero(size)), hessian_(Eigen::MatrixXd::Zero(size, size)) {}

  // Adds the residuals of one picture: transforms the sums of each capsule to the coordinates that move the capsule
  // (chain rule). There are far fewer capsules than residuals.
  void Add(const ResidualSums& sums, const TreeFrames& frames, const ProjectionMatrix& matrix) {
    const PixelScale camera(matrix);
    for (std::size_t i = 0; i < body_.flesh.size(); ++i) {
      const ConeSums& of = sums.capsules[i];
      const bool is_empty = std::ranges::all_of(of.hessian, [](const double(&column)[8]) {
        return std::ranges::all_of(std::span(column).first(6), [](double x) { return x == 0; });
      });
      if (is_empty) continue;
      MoveCapsule(body_.flesh[i], frames, camera);
      Transform(of);
    }
  }

  // Adds the joints seen in one picture.
  void Add(std::span<const SeenJoint> joints, const TreeFrames& frames, const ProjectionMatrix& matrix,
           const SilhouetteCostOptions& options) {
    const PixelScale camera(matrix);
    for (const SeenJoint& seen : joints) {
      const JointError error = JointErrorOf(seen, body_, frames, camera, options);
      if (error.weight == 0) continue;
      const TreePoint& point = body_.roles[Index(seen.role)];
      const glm::dvec3 p_WQ = PlaceOf(point, frames);
      const PixelScale::Slopes at = camera.SlopesAt(p_WQ);
      // Compute the derivatives of the joint's pixel with respect to every coordinate that moves the joint.
      slopes_.clear();
      ForEachMotion(point.joint, frames, [&](int coordinate, const glm::dvec3& axis, const glm::dvec3* about) {
        const glm::dvec3 moves = about == nullptr ? axis : glm::cross(axis, p_WQ - *about);
        slopes_.push_back({coordinate, {glm::dot(at.u, moves), glm::dot(at.v, moves)}});
      });
      for (std::size_t j = 0; j < slopes_.size(); ++j) {
        const auto& [at_j, slope_j] = slopes_[j];
        gradient_[at_j] += error.weight * glm::dot(error.off, slope_j);
        for (std::size_t k = 0; k <= j; ++k) {
          hessian_(slopes_[k].first, at_j) += error.weight * glm::dot(slope_j, slopes_[k].second);
        }
      }
    }
  }

  // Adds the squared term (value / spread)² of one coordinate.
  void AddSquare(int coordinate, double value, double spread) {
    gradient_[coordinate] += value / (spread * spread);
    hessian_(coordinate, coordinate) += 1 / (spread * spread);
  }

  const Eigen::VectorXd& gradient() const { return gradient_; }
  Eigen::MatrixXd Hessian() const {
    Eigen::MatrixXd hessian = hessian_ + hessian_.transpose();
    hessian.diagonal() = hessian_.diagonal();
    return hessian;
  }

 private:
  // Adds the sums of one capsule, transformed to the coordinates of motion_. Each sum of six products is
  // computed as two interleaved sums of three.
  void Transform(const ConeSums& of) {
    const auto& rows = motion_.rows;
    const std::size_t count = motion_.count;
    // Multiply the Hessian by every column, all columns at once.
    std::array<std::array<double, CapsuleMotion::kMaxCount>, 6> x;
    for (std::size_t row = 0; row < 6; ++row) {
      for (std::size_t j = 0; j < count; ++j) x[row][j] = of.hessian[0][row] * rows[0][j];
      for (std::size_t column = 1; column < 6; ++column) {
        for (std::size_t j = 0; j < count; ++j) x[row][j] += of.hessian[column][row] * rows[column][j];
      }
    }
    // Add the products of each coordinate with itself and the coordinates before it.
    for (std::size_t j = 0; j < count; ++j) {
      const double* const g = of.gradient;
      const int at_j = motion_.coordinates[j];
      gradient_[at_j] += (g[0] * rows[0][j] + (g[2] * rows[2][j] + g[4] * rows[4][j])) +
                         (g[1] * rows[1][j] + (g[3] * rows[3][j] + g[5] * rows[5][j]));
      const double x0 = x[0][j], x1 = x[1][j], x2 = x[2][j], x3 = x[3][j], x4 = x[4][j], x5 = x[5][j];
      std::array<double, CapsuleMotion::kMaxCount> products;
      for (std::size_t k = 0; k <= j; ++k) {
        products[k] = (x0 * rows[0][k] + (x2 * rows[2][k] + x4 * rows[4][k])) +
                      (x1 * rows[1][k] + (x3 * rows[3][k] + x5 * rows[5][k]));
      }
      double* const column = hessian_.col(at_j).data();
      for (std::size_t k = 0; k <= j; ++k) column[motion_.coordinates[k]] += products[k];
    }
  }

  void MoveCapsule(const FleshCapsule& flesh, const TreeFrames& frames, const PixelScale& camera) {
    assert(flesh.a.joint == flesh.b.joint);
    motion_.count = 0;
    const glm::dvec3 p_WA = PlaceOf(flesh.a, frames), p_WB = PlaceOf(flesh.b, frames);
    const PixelScale::Slopes at_a = camera.SlopesAt(p_WA), at_b = camera.SlopesAt(p_WB);
    ForEachMotion(flesh.a.joint, frames, [&](int coordinate, const glm::dvec3& axis, const glm::dvec3* about) {
      const glm::dvec3 moves_a = about == nullptr ? axis : glm::cross(axis, p_WA - *about);
      const glm::dvec3 moves_b = about == nullptr ? axis : glm::cross(axis, p_WB - *about);
      const std::size_t j = motion_.count++;
      assert(j < CapsuleMotion::kMaxCount);
      motion_.coordinates[j] = coordinate;
      motion_.rows[0][j] = glm::dot(at_a.u, moves_a);
      motion_.rows[1][j] = glm::dot(at_a.v, moves_a);
      motion_.rows[2][j] = flesh.radius_a * glm::dot(at_a.pixels_per_metre, moves_a);
      motion_.rows[3][j] = glm::dot(at_b.u, moves_b);
      motion_.rows[4][j] = glm::dot(at_b.v, moves_b);
      motion_.rows[5][j] = flesh.radius_b * glm::dot(at_b.pixels_per_metre, moves_b);
    });
  }

  // Calls take(coordinate, axis, about) for every coordinate that moves the limb of `joint`: a translation along `axis`
  // if `about` is null, otherwise a rotation about the line through `about` along `axis`.
  template <typename Take>
  void ForEachMotion(int joint, const TreeFrames& frames, const Take& take) const {
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 unit(0);
      unit[axis] = 1;
      take(axis, unit, nullptr);
      take(3 + axis, unit, &frames.joints[0].position);
    }
    for (int j = joint; j >= 0; j = body_.tree.joints[j].parent) {
      const TreeJoint& moved = body_.tree.joints[j];
      for (int dof = moved.first_dof; dof < moved.first_dof + moved.dof_count; ++dof) {
        take(kRootDofs + dof, frames.dof_axes[dof], &frames.joints[j].position);
      }
    }
  }

  const SilhouetteBody& body_;
  CapsuleMotion motion_;
  std::vector<std::pair<int, glm::dvec2>> slopes_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;  // symmetric, but of the entries (i, k) and (k, i) only one is filled; the other is 0
};

// Calls take(coordinate, value, spread) for every squared term (value / spread)² of the priors.
template <typename Take>
void ForEachPrior(const SilhouetteBody& body, const TreeState& state, const PosePrior* prior, Take take) {
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    take(kRootDofs + static_cast<int>(i), state.angles[i] - body.habits[i].angle, body.habits[i].spread);
  }
  if (prior == nullptr) return;
  const glm::dvec3 moved = state.root_position - prior->near.root_position;
  const glm::dvec3 turned = TurnOf(state.root_frame * glm::transpose(prior->near.root_frame));
  for (int axis = 0; axis < 3; ++axis) {
    take(axis, moved[axis], prior->place_m);
    take(3 + axis, turned[axis], prior->turn_rad);
  }
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    take(kRootDofs + static_cast<int>(i), state.angles[i] - prior->near.angles[i], prior->angle_rad);
  }
}

// Projects the flesh capsules of the body in the pose `state` into all views: fills `workspace.frames` and
// `workspace.kept`.
void See(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
         FitWorkspace& workspace) {
  ComputeFrames(body.tree, state, workspace.frames);
  workspace.kept.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    ProjectFlesh(body, workspace.frames, views[i].matrix, workspace.kept[i].capsules);
    MeasureFlesh(*views[i].silhouette, workspace.kept[i]);
  }
}

// Linearises the residuals at `state`; `workspace.kept` and `workspace.frames` must hold the capsules and frames of
// this pose.
Linearisation LineariseAt(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                          const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  Linearisation linear(body, kRootDofs + body.tree.dof_count());
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SilhouetteView& view = views[i];
    SumResiduals(workspace.kept[i], *view.silhouette, options, workspace.sums);
    linear.Add(workspace.sums, workspace.frames, view.matrix);
    linear.Add(view.joints, workspace.frames, view.matrix, options);
  }
  ForEachPrior(body, state, prior,
               [&](int coordinate, double value, double spread) { linear.AddSquare(coordinate, value, spread); });
  return linear;
}

// For each angle, returns true if the angle is at a limit and a descent step would leave the range.
std::vector<bool> Held(const KinematicTree& tree, const TreeState& state, const Eigen::VectorXd& gradient) {
  std::vector<bool> held(gradient.size(), false);
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    const double downhill = -gradient[kRootDofs + static_cast<Eigen::Index>(i)];
    const AngleRange& range = tree.limits[i];
    held[kRootDofs + i] =
        (state.angles[i] <= range.lower && downhill < 0) || (state.angles[i] >= range.upper && downhill > 0);
  }
  return held;
}

// Returns the damped Gauss–Newton step; held coordinates do not move.
Eigen::VectorXd Step(const Linearisation& linear, const std::vector<bool>& held, double damping) {
  Eigen::MatrixXd h = linear.Hessian();
  Eigen::VectorXd g = linear.gradient();
  constexpr double kMinDiagonal = 1e-6;
  for (Eigen::Index i = 0; i < g.size(); ++i) {
    h(i, i) += damping * h(i, i) + kMinDiagonal;
    if (!held[i]) continue;
    h.row(i).setZero();
    h.col(i).setZero();
    h(i, i) = 1;
    g[i] = 0;
  }
  return -h.llt().solve(g);
}

// Adds the cost of one picture to `sum`. `frames` is the body's pose; `flesh` is the body in this pose, projected into
// the picture.
void AddPictureCost(const SilhouetteBody& body, const SilhouetteView& view, const SilhouetteCostOptions& options,
                    const SeenFlesh& flesh, const TreeFrames& frames, double& sum) {
  AddLosses(flesh, *view.silhouette, options, sum);
  const PixelScale camera(view.matrix);
  for (const SeenJoint& seen : view.joints) sum += JointErrorOf(seen, body, frames, camera, options).loss;
}

// Returns `cost` plus the cost of the priors.
double WithPriors(const SilhouetteBody& body, const TreeState& state, const PosePrior* prior, double cost) {
  ForEachPrior(body, state, prior,
               [&](int, double value, double spread) { cost += value * value / (spread * spread); });
  return cost;
}

}  // namespace

SilhouetteFit CostOf(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                     const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace,
                     double limit) {
  constexpr double kRounding = 1e-9;  // far above the relative rounding error of a sum
  SilhouetteFit fit{.state = state};
  const double most = limit * (1 + kRounding) - WithPriors(body, state, prior, 0);
  ComputeFrames(body.tree, state, workspace.frames);
  workspace.flesh.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (fit.picture_cost > most) {
      fit.cost = std::numeric_limits<double>::infinity();
      return fit;
    }
    SeenFlesh& flesh = workspace.flesh[i];
    ProjectFlesh(body, workspace.frames, views[i].matrix, flesh.capsules);
    MeasureFlesh(*views[i].silhouette, flesh);
    AddPictureCost(body, views[i], options, flesh, workspace.frames, fit.picture_cost);
  }
  fit.cost = WithPriors(body, state, prior, fit.picture_cost);
  return fit;
}

NormalEquations NormalEquationsAt(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const PosePrior* prior, const SilhouetteCostOptions& options,
                                  FitWorkspace& workspace) {
  See(body, views, state, workspace);
  const Linearisation linear = LineariseAt(body, views, state, prior, options, workspace);
  const Eigen::MatrixXd hessian = linear.Hessian();
  return {{linear.gradient().begin(), linear.gradient().end()}, {hessian.data(), hessian.data() + hessian.size()}};
}

SilhouetteFit FitSilhouettes(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                             const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace) {
  See(body, views, start, workspace);
  return FitFurther(body, views, start, prior, options, workspace);
}

SilhouetteFit FitFurther(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                         const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace) {
  constexpr double kFirstDamping = 1e-2, kGrows = 4, kShrinks = 0.3, kMaxDamping = 1e6;
  ComputeFrames(body.tree, start, workspace.frames);
  SilhouetteFit fit{.state = start};
  for (std::size_t i = 0; i < views.size(); ++i) {
    AddPictureCost(body, views[i], options.cost, workspace.kept[i], workspace.frames, fit.picture_cost);
  }
  fit.cost = WithPriors(body, start, prior, fit.picture_cost);
  double damping = kFirstDamping;
  while (fit.iterations < options.max_iterations && damping < kMaxDamping) {
    // Linearise at the current pose. Angles that are held at a limit are left out of the step.
    const Linearisation linear = LineariseAt(body, views, fit.state, prior, options.cost, workspace);
    const std::vector<bool> held = Held(body.tree, fit.state, linear.gradient());
    bool is_better = false;
    // Raise the damping until a step lowers the cost.
    while (!is_better && fit.iterations < options.max_iterations && damping < kMaxDamping) {
      ++fit.iterations;
      const Eigen::VectorXd step = Step(linear, held, damping);
      SilhouetteFit trial =
          CostOf(body, views, Moved(body.tree, fit.state, {step.data(), static_cast<std::size_t>(step.size())}), prior,
                 options.cost, workspace, fit.cost);
      is_better = trial.cost < fit.cost;
      damping = is_better ? damping * kShrinks : damping * kGrows;
      if (!is_better) continue;
      std::swap(workspace.flesh, workspace.kept);
      const bool is_last = fit.cost - trial.cost < options.enough * fit.cost;
      trial.iterations = fit.iterations;
      fit = std::move(trial);
      if (is_last) return fit;
    }
  }
  return fit;
}

}  // namespace etude
