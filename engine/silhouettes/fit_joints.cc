#include "engine/silhouettes/fit_joints.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>

#include "engine/base/angles.h"
#include "engine/silhouettes/lost_limbs.h"
#include "engine/silhouettes/turns.h"

namespace etude {
namespace {

class JointFit {
 public:
  JointFit(const SilhouetteBody& body, const JointTargets& targets) : body_(body), targets_(targets) {}

  double CostOf(const TreeState& state) {
    ComputeFrames(body_.tree, state, frames_);
    double cost = 0;
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      if (!targets_[i]) continue;
      const glm::dvec3 off = PlaceOf(body_.roles[i], frames_) - targets_[i]->p_WQ;
      cost += glm::dot(off, off) / (targets_[i]->sigma_m * targets_[i]->sigma_m);
    }
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      const double strays = (state.angles[i] - body_.habits[i].angle) / body_.habits[i].spread;
      cost += strays * strays;
    }
    return cost;
  }

  // Minimises the cost from `state`, in place; returns the final cost.
  double Minimise(TreeState& state) {
    constexpr int kMaxSteps = 60;
    constexpr double kEnough = 1e-9, kMaxDamping = 1e8;
    double cost = CostOf(state), damping = 1e-3;
    for (int step = 0; step < kMaxSteps && damping < kMaxDamping; ++step) {
      // Compute a damped Gauss–Newton step from the linearisation.
      Linearise(state);
      const Eigen::VectorXd by = StepWith(state, damping);
      const TreeState trial = Moved(body_.tree, state, {by.data(), static_cast<std::size_t>(by.size())});
      const double trial_cost = CostOf(trial);
      // Reject a step that does not lower the cost, and raise the damping.
      if (trial_cost >= cost) {
        damping *= 4;
        continue;
      }
      const bool is_last = cost - trial_cost < kEnough * cost;
      state = trial;
      cost = trial_cost;
      damping *= 0.3;
      if (is_last) break;
    }
    return cost;
  }

 private:
  // Computes the gradient of half the cost and the Gauss–Newton Hessian.
  void Linearise(const TreeState& state) {
    const Eigen::Index size = kRootDofs + body_.tree.dof_count();
    gradient_ = Eigen::VectorXd::Zero(size);
    hessian_ = Eigen::MatrixXd::Zero(size, size);
    ComputeFrames(body_.tree, state, frames_);
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      if (!targets_[i]) continue;
      const Eigen::MatrixXd motion = MotionOf(body_.roles[i], size);
      const glm::dvec3 off = PlaceOf(body_.roles[i], frames_) - targets_[i]->p_WQ;
      const double weight = 1 / (targets_[i]->sigma_m * targets_[i]->sigma_m);
      gradient_ += weight * motion.transpose() * Eigen::Vector3d(off.x, off.y, off.z);
      hessian_ += weight * motion.transpose() * motion;
    }
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      const double weight = 1 / (body_.habits[i].spread * body_.habits[i].spread);
      gradient_[kRootDofs + i] += weight * (state.angles[i] - body_.habits[i].angle);
      hessian_(kRootDofs + i, kRootDofs + i) += weight;
    }
  }

  // Returns the Jacobian (3 rows) of a point's position with respect to every coordinate.
  Eigen::MatrixXd MotionOf(const TreePoint& point, Eigen::Index size) const {
    Eigen::MatrixXd motion = Eigen::MatrixXd::Zero(3, size);
    const glm::dvec3 p_WQ = PlaceOf(point, frames_);
    const auto turn = [&](Eigen::Index coordinate, const glm::dvec3& axis, const glm::dvec3& about) {
      const glm::dvec3 moves = glm::cross(axis, p_WQ - about);
      motion.col(coordinate) = Eigen::Vector3d(moves.x, moves.y, moves.z);
    };
    // Fill the root's columns: three translations and three rotations.
    for (int axis = 0; axis < 3; ++axis) {
      motion(axis, axis) = 1;
      glm::dvec3 unit(0);
      unit[axis] = 1;
      turn(3 + axis, unit, frames_.joints[0].position);
    }
    // Fill the columns of the angles that move the point: of every joint from the point's limb up to the root.
    for (int j = point.joint; j >= 0; j = body_.tree.joints[j].parent) {
      const TreeJoint& joint = body_.tree.joints[j];
      for (int dof = joint.first_dof; dof < joint.first_dof + joint.dof_count; ++dof) {
        turn(kRootDofs + dof, frames_.dof_axes[dof], frames_.joints[j].position);
      }
    }
    return motion;
  }

  // Returns the damped step. An angle at a limit does not move if its gradient points out of the range.
  Eigen::VectorXd StepWith(const TreeState& state, double damping) const {
    Eigen::MatrixXd h = hessian_;
    Eigen::VectorXd g = gradient_;
    for (Eigen::Index i = 0; i < g.size(); ++i) h(i, i) *= 1 + damping;
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      const Eigen::Index at = kRootDofs + static_cast<Eigen::Index>(i);
      const AngleRange& range = body_.tree.limits[i];
      const bool is_held =
          (state.angles[i] <= range.lower && g[at] > 0) || (state.angles[i] >= range.upper && g[at] < 0);
      if (!is_held) continue;
      h.row(at).setZero();
      h.col(at).setZero();
      h(at, at) = 1;
      g[at] = 0;
    }
    return -h.llt().solve(g);
  }

  const SilhouetteBody& body_;
  const JointTargets& targets_;
  TreeFrames frames_;
  Eigen::VectorXd gradient_;
  Eigen::MatrixXd hessian_;
};

// Returns the mean position of all targets, an estimate of the body's position.
glm::dvec3 MiddleOf(const JointTargets& targets) {
  glm::dvec3 sum(0);
  int count = 0;
  for (const auto& target : targets) {
    if (!target) continue;
    sum += target->p_WQ;
    ++count;
  }
  return count > 0 ? sum / static_cast<double>(count) : sum;
}

}  // namespace

TreeState FitJoints(const SilhouetteBody& body, const JointTargets& targets, const std::optional<TreeState>& start) {
  JointFit fit(body, targets);
  if (start) {
    TreeState state = *start;
    fit.Minimise(state);
    return state;
  }
  // Without a start pose, minimise from every heading and posture, and keep the pose with the lowest cost.
  constexpr int kHeadings = 4;
  std::optional<TreeState> best;
  double least = 0;
  for (int i = 0; i < kHeadings; ++i) {
    for (TreeState state : Postures(body)) {
      state.root_position = MiddleOf(targets);
      state.root_frame = RotationBy({0, 2 * kPi * i / kHeadings, 0}) * state.root_frame;
      const double cost = fit.Minimise(state);
      if (best && cost >= least) continue;
      least = cost;
      best = std::move(state);
    }
  }
  return *best;
}

JointTargets TargetsOf(const BodyPose& pose, double sigma_m) {
  JointTargets targets;
  for (std::size_t i = 0; i < kRoleCount; ++i) targets[i] = {pose.joints[i], sigma_m};
  return targets;
}

TreeState TurnedRound(const SilhouetteBody& body, const TreeState& state) {
  constexpr double kExact = 0.05;  // standard deviation of the target positions, metres
  const BodyPose pose = ToBodyPose(body, state);
  BodyPose exchanged;
  for (const Role role : AllRoles()) exchanged[role] = pose[Mirrored(role)];
  JointTargets targets = TargetsOf(exchanged, kExact);
  for (const Role role : {Role::kLeftFoot, Role::kRightFoot, Role::kHead}) targets[Index(role)].reset();
  TreeState start = state;
  start.root_frame = RotationBy({0, kPi, 0}) * state.root_frame;
  return FitJoints(body, targets, start);
}

}  // namespace etude
