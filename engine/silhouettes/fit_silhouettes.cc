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

// The derivatives of a capsule's two projected ends. Each coordinate that moves the capsule's limb has one column: the
// derivatives of the six numbers that SilhouetteResidual calls δ.
struct CapsuleMotion {
  std::vector<int> coordinates;
  std::vector<std::array<double, 6>> columns;
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

  // Adds the residuals of one picture. Residuals are summed by capsule first and only then transformed to coordinates,
  // because there are far fewer capsules than residuals.
  void Add(const std::vector<SilhouetteResidual>& residuals, const TreeFrames& frames, const ProjectionMatrix& matrix,
           const SilhouetteCostOptions& options) {
    using Six = Eigen::Matrix<double, 6, 1>;
    using SixBySix = Eigen::Matrix<double, 6, 6>;
    // Sum gradient and Hessian of each capsule, with respect to its six numbers.
    std::vector<Six> gradients(body_.flesh.size(), Six::Zero());
    std::vector<SixBySix> hessians(body_.flesh.size(), SixBySix::Zero());
    for (const SilhouetteResidual& residual : residuals) {
      const Eigen::Map<const Six> slopes(residual.slopes.data());
      const double weight = LossOf(residual, options).weight;
      gradients[residual.capsule] += weight * residual.value * slopes;
      hessians[residual.capsule] += weight * slopes * slopes.transpose();
    }
    // Transform these gradients and Hessians to the coordinates that move the capsules (chain rule).
    const PixelScale camera(matrix);
    for (std::size_t i = 0; i < body_.flesh.size(); ++i) {
      if (hessians[i].isZero(0)) continue;
      MoveCapsule(body_.flesh[i], frames, camera);
      const std::size_t count = motion_.coordinates.size();
      for (std::size_t j = 0; j < count; ++j) {
        const Eigen::Map<const Six> column_j(motion_.columns[j].data());
        const Six projected = hessians[i] * column_j;
        const int at_j = motion_.coordinates[j];
        gradient_[at_j] += gradients[i].dot(column_j);
        for (std::size_t k = 0; k <= j; ++k) {
          const double product = projected.dot(Eigen::Map<const Six>(motion_.columns[k].data()));
          const int at_k = motion_.coordinates[k];
          hessian_(at_j, at_k) += product;
          if (at_j != at_k) hessian_(at_k, at_j) += product;
        }
      }
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
      for (const auto& [j, slope_j] : slopes_) {
        gradient_[j] += error.weight * glm::dot(error.off, slope_j);
        for (const auto& [k, slope_k] : slopes_) hessian_(j, k) += error.weight * glm::dot(slope_j, slope_k);
      }
    }
  }

  // Adds the squared term (value / spread)² of one coordinate.
  void AddSquare(int coordinate, double value, double spread) {
    gradient_[coordinate] += value / (spread * spread);
    hessian_(coordinate, coordinate) += 1 / (spread * spread);
  }

  const Eigen::VectorXd& gradient() const { return gradient_; }
  const Eigen::MatrixXd& hessian() const { return hessian_; }

 private:
  void MoveCapsule(const FleshCapsule& flesh, const TreeFrames& frames, const PixelScale& camera) {
    assert(flesh.a.joint == flesh.b.joint);
    motion_.coordinates.clear();
    motion_.columns.clear();
    const glm::dvec3 p_WA = PlaceOf(flesh.a, frames), p_WB = PlaceOf(flesh.b, frames);
    const PixelScale::Slopes at_a = camera.SlopesAt(p_WA), at_b = camera.SlopesAt(p_WB);
    const auto add = [&](int coordinate, const glm::dvec3& moves_a, const glm::dvec3& moves_b) {
      motion_.coordinates.push_back(coordinate);
      motion_.columns.push_back({glm::dot(at_a.u, moves_a), glm::dot(at_a.v, moves_a),
                                 flesh.radius_a * glm::dot(at_a.pixels_per_metre, moves_a), glm::dot(at_b.u, moves_b),
                                 glm::dot(at_b.v, moves_b), flesh.radius_b * glm::dot(at_b.pixels_per_metre, moves_b)});
    };
    ForEachMotion(flesh.a.joint, frames, [&](int coordinate, const glm::dvec3& axis, const glm::dvec3* about) {
      if (about == nullptr) return add(coordinate, axis, axis);
      add(coordinate, glm::cross(axis, p_WA - *about), glm::cross(axis, p_WB - *about));
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
  Eigen::MatrixXd hessian_;
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
// `workspace.flesh`.
void See(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
         FitWorkspace& workspace) {
  ComputeFrames(body.tree, state, workspace.frames);
  workspace.flesh.resize(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    ProjectFlesh(body, workspace.frames, views[i].matrix, workspace.flesh[i].capsules);
    MeasureFlesh(*views[i].silhouette, workspace.flesh[i]);
  }
}

// Linearises the residuals at `state`; `workspace.kept` must hold the capsules projected in this pose.
Linearisation LineariseAt(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                          const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  Linearisation linear(body, kRootDofs + body.tree.dof_count());
  ComputeFrames(body.tree, state, workspace.frames);
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SilhouetteView& view = views[i];
    workspace.residuals.clear();
    AppendResiduals(workspace.kept[i], *view.silhouette, options, workspace.residuals);
    linear.Add(workspace.residuals, workspace.frames, view.matrix, options);
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
  Eigen::MatrixXd h = linear.hessian();
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

// Computes the cost of `state`; `flesh` holds the capsules projected in that pose.
SilhouetteFit CostOfSeen(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                         const PosePrior* prior, const SilhouetteCostOptions& options,
                         const std::vector<SeenFlesh>& flesh, const FitWorkspace& workspace) {
  SilhouetteFit fit{.state = state};
  for (std::size_t i = 0; i < views.size(); ++i) {
    const SilhouetteView& view = views[i];
    AddLosses(flesh[i], *view.silhouette, options, fit.picture_cost);
    const PixelScale camera(view.matrix);
    for (const SeenJoint& seen : view.joints) {
      fit.picture_cost += JointErrorOf(seen, body, workspace.frames, camera, options).loss;
    }
  }
  fit.cost = fit.picture_cost;
  ForEachPrior(body, state, prior,
               [&](int, double value, double spread) { fit.cost += value * value / (spread * spread); });
  return fit;
}

}  // namespace

SilhouetteFit CostOf(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state,
                     const PosePrior* prior, const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  See(body, views, state, workspace);
  return CostOfSeen(body, views, state, prior, options, workspace.flesh, workspace);
}

NormalEquations NormalEquationsAt(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const PosePrior* prior, const SilhouetteCostOptions& options,
                                  FitWorkspace& workspace) {
  See(body, views, state, workspace);
  std::swap(workspace.flesh, workspace.kept);
  const Linearisation linear = LineariseAt(body, views, state, prior, options, workspace);
  return {{linear.gradient().begin(), linear.gradient().end()},
          {linear.hessian().data(), linear.hessian().data() + linear.hessian().size()}};
}

SilhouetteFit FitSilhouettes(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                             const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace) {
  See(body, views, start, workspace);
  std::swap(workspace.flesh, workspace.kept);
  return FitFurther(body, views, start, prior, options, workspace);
}

SilhouetteFit FitFurther(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& start,
                         const PosePrior* prior, const FitOptions& options, FitWorkspace& workspace) {
  constexpr double kFirstDamping = 1e-2, kGrows = 4, kShrinks = 0.3, kMaxDamping = 1e6;
  ComputeFrames(body.tree, start, workspace.frames);
  SilhouetteFit fit = CostOfSeen(body, views, start, prior, options.cost, workspace.kept, workspace);
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
                 options.cost, workspace);
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
