#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/kinematics/capture_body.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"
#include "engine/motion/body.h"
#include "engine/motion/rest_body.h"

namespace etude {

/// Target places of the twenty roles, with weights.
struct PoseTargets {
  BodyPose places;                           ///< in the world, metres
  std::array<double, kRoleCount> weights{};  ///< 0: it is not known where the role is
};

/// Makes targets of a pose in which every role counts alike.
PoseTargets TargetsAt(const BodyPose& pose);

/// A pose of a body, and how far its roles are from their places: Σ weight · |place − role|², square metres.
struct PoseFit {
  TreeState state;
  double squares = 0;
};

/// Finds poses of one body from the places of its joints. *(Ours.)* Two steps: from the root outwards every limb points
/// to where the next known joints are, its twist from elbows and knees (`CaptureBody::Twist`); then Gauss–Newton steps
/// bring all roles as near to their places as they can be at once, and leave angles that nothing tells of where the
/// first step put them. A pose of the body comes back exactly, as far as its places say what it is.
class PoseFitter {
 public:
  /// `body` must outlive this.
  explicit PoseFitter(const CaptureBody& body);
  PoseFitter(const PoseFitter&) = delete;
  PoseFitter& operator=(const PoseFitter&) = delete;

  /// Finds the angles that minimise Σ weight · |place − role|², at least locally; the root stands at the place of the
  /// left foot. Where places are not met, and not about as nearly as `last` met its own (the frame before of a motion,
  /// if there is one), that pose is tried as a start, too, and every joint that no place tells bent the other
  /// way: the least of these minima is the answer. Nothing when a place that counts is not finite, or the left foot's
  /// does not count.
  std::optional<PoseFit> Fit(const PoseTargets& wanted, const std::optional<PoseFit>& last = {}) const;
  /// Finds the minimum near a state of the body instead; its root is kept.
  TreeState Improve(const PoseTargets& wanted, const TreeState& state) const;

 private:
  /// A known role that is met first on the way outwards, and where it is from a limb when all angles beyond are zero.
  struct Aim {
    Role role;
    glm::dvec3 p_LQ{0};
    bool is_on_limb = false;
  };

  /// The first step, and the limbs of which a joint beyond bends that no place tells.
  struct Pointed {
    TreeState state;
    std::vector<int> bent;
  };

  /// `mirrored`: the limb that bends the other way; −1: none.
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
  const KinematicTree tree_;  // with an effector for every role that the root does not hold
  const GaussNewtonSolver solver_;
  std::vector<std::vector<int>> children_;
};

/// The distances of joints from where a body that keeps its lengths can bring them.
struct RigidMisfit {
  double mean_m = 0;   ///< of the worst joint of each pose
  double worst_m = 0;  ///< of that joint in that pose
  Role role = Role::kHipCentre;
  std::size_t pose = 0;
};

/// Fits the body `rest` to at most `most` of the poses, evenly over all, each by itself but for a start from the one
/// before. Nothing without poses, or where `FittedBody` makes no body of it.
std::optional<RigidMisfit> MeasureRigidMisfit(const RestBody& rest, std::span<const BodyPose> poses, std::size_t most);

}  // namespace etude
