#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves by FABRIK (Aristidou and Lasenby 2011), which moves joints as points, backward from the targets and forward
/// from the root (`FabrikPass`). It uses positions only; the targets' axes are ignored but still count in the errors.
/// The step from points to angles is *ours*. After every pair of passes, all joints turn twice, parents before
/// children. A joint turns hinge by hinge, each hinge within its range, in the pose that all earlier turns have
/// produced. The first turn of a joint brings the tips of its own limb as near as possible to their positions after
/// the passes; it does not twist a limb whose tips lie on the limb's axis. The second turn does the same for all tips
/// beyond the joint. It compensates for hinges and limits farther out: without it, a wrist at its limit would keep
/// its hand away from the target. Without the first turn, the solver takes twice as many steps and solves only three
/// of four problems. The next passes begin at the resulting pose. The errors of this pose are measured, so a goal
/// counts as reached only if the angles reach it. A limb in line with its target stays in line (paper B, figure 3.8),
/// because points on a line move only along it. `IkOptions::weights` and `refresh` do not apply. One iteration is one
/// pair of passes with both turns of all joints, and costs one forward-kinematics pass.
IkSolution SolveFabrik(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// FABRIK's two passes (Aristidou and Lasenby 2011) over a tree of rigid limbs, on positions alone. A limb has a base
/// (its joint) and tips (the joints beyond it, the effectors at its end). With one tip this is exactly the paper's
/// rule: the tip moves to its desired position, and the base follows on the line to its old position. With several
/// tips, the paper moves their common joint (its sub-base) to the mean of the positions to which the chains beyond it
/// lead. The paper has no rule for tips that form one rigid limb, like shoulders and neck. *Ours*: such a limb turns so
/// that it fits its tips by least squares:
/// - backward, tips to root: the mean of the tips moves to the mean of their desired positions; the limb turns about
///   this mean to fit the tips and the old position of its base, which has the weight of one tip;
/// - forward, root to tips: the base is at the end of the limb before; the limb turns about its base to fit the tips.
/// Both passes use the smallest rotation: a limb whose points lie on one line does not turn about that line. A limb
/// without a target moves along with the limb before it.
class FabrikPass {
 public:
  /// A point T of a limb through which the limb's chain continues to a target: the base of another limb, or an
  /// effector.
  struct Tip {
    glm::dvec3 p_LT;    ///< T in the frame of the limb L, metres
    int limb = -1;      ///< the limb whose base is at T, or −1
    int effector = -1;  ///< the effector at T, or −1
  };

  FabrikPass(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Runs the backward and the forward pass, starting from the limbs in `frames`.
  void Run(const TreeFrames& frames);

  /// Returns the tips of one limb; an empty span if there is no target beyond the limb.
  std::span<const Tip> tips(int limb) const { return tips_[limb]; }
  /// Returns the frame of every limb (base and axes) after the last run.
  std::span<const LimbFrame> limbs() const { return limbs_; }

 private:
  void LayBackward(int limb);
  void LayForward(int limb);
  glm::dvec3 DesiredPosition(const Tip& tip) const;

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  std::vector<std::vector<Tip>> tips_;  ///< the tips of each limb
  std::vector<LimbFrame> limbs_;
  std::vector<glm::dvec3> desired_bases_;
  std::vector<glm::dvec3> from_, to_;
};

/// Returns the rotation R that minimises Σ |R from − to|². If all of `from` lie on one line, returns the smallest such
/// rotation; if the vectors determine no rotation, returns the identity.
glm::dmat3 BestTurn(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

}  // namespace etude
