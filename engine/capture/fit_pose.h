#pragma once

#include <array>
#include <optional>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"

namespace etude {

/// Target positions of the twenty roles, with weights.
struct PoseTargets {
  BodyPose places;                           ///< target positions in the world, metres
  std::array<double, kRoleCount> weights{};  ///< weight of each role; 0 if its position is unknown
};

/// Returns a pose as targets of equal weight.
PoseTargets TargetsAt(const BodyPose& pose);

/// A pose of a body, and its residual Σ weight · |target − role|², m².
struct PoseFit {
  TreeState state;
  double squares = 0;
};

/// Finds poses of one body from the positions of its joints. *(Ours.)* In the first step, from the root outwards, every
/// limb points to the next known joints; the planes in which elbows and knees bend determine the twist of limbs
/// (`CaptureBody::Twist`). Then Gauss–Newton steps minimise the distances of all roles to their targets together;
/// angles that no target determines keep their values of the first step. If the targets are a pose of the body, that
/// pose is found exactly, as far as positions determine it.
class PoseFitter {
 public:
  /// `body` must outlive this object.
  explicit PoseFitter(const CaptureBody& body);
  PoseFitter(const PoseFitter&) = delete;
  PoseFitter& operator=(const PoseFitter&) = delete;

  /// Finds angles that minimise Σ weight · |target − role|², at least locally; the root is at the target of the left
  /// foot. `last` is the fit of the frame before, if there is one. If targets are not met and the residual is clearly
  /// larger than that of `last`, more starts are tried: the pose of `last`, and, for every joint without a target, a
  /// pose with this joint bent to the other side. The lowest minimum found is returned. Returns nullopt if a target
  /// with a weight above 0 is not finite, or if the left foot has weight 0.
  std::optional<PoseFit> Fit(const PoseTargets& wanted, const std::optional<PoseFit>& last = {}) const;
  /// Finds the local minimum of the residual (see `Fit`) near `state`; the root does not move.
  TreeState Improve(const PoseTargets& wanted, const TreeState& state) const;

 private:
  /// A role whose target shows where a limb L points: a role on L, or the first role with a target on a chain of limbs
  /// beyond L.
  struct Aim {
    Role role;
    glm::dvec3 p_LQ{0};  ///< position of the role in the frame of L, if all angles beyond L are zero
    bool is_on_limb = false;
  };

  /// The result of the first step: the pose, and the limbs whose chain was bent at a joint without a target.
  struct Pointed {
    TreeState state;
    std::vector<int> bent;
  };

  /// `mirrored` is the limb whose bend is mirrored, −1 for none.
  Pointed Point(const PoseTargets& wanted, int mirrored = -1) const;
  PoseFit Settle(const PoseTargets& wanted, const TreeState& start) const;
  void AddAims(int limb, const glm::dvec3& p_LJ, const glm::dmat3& R_LJ, int beyond, const PoseTargets& wanted,
               std::vector<Aim>& aims) const;
  glm::dmat3 BendTowards(int limb, const Aim& aim, const glm::dvec3& to_W, const glm::dmat3& R_WL,
                         const glm::dvec3& back_W, int mirrored) const;
  glm::dmat3 TurnTowards(int limb, const glm::dvec3& p_WL, const glm::dmat3& R_WJ, const PoseTargets& wanted,
                         int mirrored, std::vector<int>& bent) const;

  const CaptureBody& body_;
  std::vector<Role> effector_roles_;
  const KinematicTree tree_;  // the body's tree with one effector per role that is not fixed to the root
  const GaussNewtonSolver solver_;
  std::vector<std::vector<int>> children_;
};

}  // namespace etude
