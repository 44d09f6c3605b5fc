#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves by FABRIK (Aristidou and Lasenby 2011): joints are points that reach forward and backward for the targets
/// (`FabrikPass`). It knows positions only; the axes of targets are not looked at and count in the errors all the same.
/// *Ours*, since points are no angles: after every pair of passes the joints, parents first, turn hinge by hinge, each
/// within its range and given where the joints before really went: first so that the tips of their own limb come as
/// near as possible to their places in the passes, without changing the twist; then again, so that all tips below do.
/// The second round makes up for hinges and limits farther out: with the first alone a wrist at its limit keeps its
/// hand from the target; with the second alone it takes twice the steps and solves three problems of four. The next
/// passes begin with that pose, and errors are measured there: nothing counts as reached that the angles do not reach.
/// A limb in line with its target stays so (figure 3.8): points on a line reach along it only. `IkOptions::weights` and
/// `refresh` do not apply. One iteration is one pair of passes with its rounds; each costs one forward-kinematics pass.
IkSolution SolveFabrik(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// FABRIK's two passes (Aristidou and Lasenby 2011) over a tree of rigid limbs, on places alone. A limb has a base (its
/// joint) and tips (the joints below it, the effectors at its end). With one tip this is the paper's rule to the
/// letter: the tip goes to its desired place, the base follows on the line to where it was. With several tips the paper
/// takes their joint (its sub-base) for the mean of what the chains below want, and has no rule for tips that are rigid
/// among themselves, like shoulders and neck. *Ours*: such a limb is laid through its tips by least squares:
/// - backward, tips to root: the mean of the tips goes to the mean of their desired places; the limb is turned about
///   it to suit the tips and, counted like one more tip, the old place of its base;
/// - forward, root to tips: the base stands where the limb above ends; the limb is turned about it to suit the tips.
/// Both turn no further than they must: never about the line of a limb whose points are in line. What leads to no
/// target moves along with the limb above.
class FabrikPass {
 public:
  /// A point T of a limb that leads to a target.
  struct Tip {
    glm::dvec3 p_LT;    ///< T in the frame of the limb L, metres
    int limb = -1;      ///< whose base it is, or
    int effector = -1;  ///< what it is the end of
  };

  FabrikPass(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Runs both passes, beginning with the limbs as they are in `frames`.
  void Run(const TreeFrames& frames);

  /// Returns the tips of one limb; none when it leads to no target.
  std::span<const Tip> tips(int limb) const { return tips_[limb]; }
  /// Returns where the last run laid the limbs: each one's base and axes.
  std::span<const LimbFrame> limbs() const { return limbs_; }

 private:
  void LayBackward(int limb);
  void LayForward(int limb);
  glm::dvec3 DesiredPosition(const Tip& tip) const;

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  std::vector<std::vector<Tip>> tips_;  ///< of each limb
  std::vector<LimbFrame> limbs_;
  std::vector<glm::dvec3> desired_bases_;
  std::vector<glm::dvec3> from_, to_;
};

/// Returns the rotation that turns the vectors `from` best into `to`, making Σ |R from − to|² least. When all of `from`
/// are in line, the smallest such rotation; none when nothing tells.
glm::dmat3 BestTurn(std::span<const glm::dvec3> from, std::span<const glm::dvec3> to);

}  // namespace etude
