#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves as `SolveGaussNewton` does, one number at a time, as one would write it down: the code to read, and the
/// oracle of the fast ones. The answer is the same to the last bit; a trace is filled if one is asked for.
IkSolution SolveGaussNewtonPlainly(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const GaussNewtonOptions& own = {});

/// Gauss–Newton steps towards targets that stay as near to a preferred posture as the targets allow. A step is
///
///     argmin |J dq − e|² + μ |q + dq − q₀|²   subject to   lower ≤ q + dq ≤ upper,
///
/// J the Jacobian of the targets, e their residuals (positions in units of 0.30 m, axes in radians), q₀ the preferred
/// posture, μ > 0 the damping. A small μ counts only where the targets leave a choice: in the null space of J.
///
/// J is never formed. As in Featherstone's articulated-body algorithm, what all targets beyond a joint ask of the limb
/// that carries the joint is one quadratic ½VᵀΛV − ηᵀV of that limb's movement V (its turn, and its shift at the root).
/// It is gathered from the leaves inwards: limbs that meet add theirs; a hinge with screw s, whose angle is the best
/// one for every V, takes Λs(Λs)ᵀ / (μ + sᵀΛs) off Λ. Outwards again from the root, which rests, the angles follow one
/// by one. The cost grows with the number of hinges alone, whatever the tree and however many its effectors.
///
/// Bounds are kept by a primal-dual active set (Hintermüller, Ito and Kunisch 2002). On the way outwards every hinge
/// compares the change that is best for it, as its limb moves now, with its range: one beyond an end is fixed at that
/// end from the next call on, one at an end that would come back is free again. Every call is one such pass, inwards
/// and outwards, so that the set converges along with the steps, which costs fewer passes than a whole set at each
/// step. The answer is within the ranges always, and the optimum when no hinge has changed sides (`is_exact`): then the
/// conditions of Karush, Kuhn and Tucker hold.
///
/// Takes its memory when made. `tree` and `targets` must outlive this.
class GaussNewtonStep {
 public:
  GaussNewtonStep(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Linearises the targets at `frames`. Returns |e|².
  double Build(const TreeFrames& frames);

  /// Returns the change of every angle, which keeps it within `ranges`; it must be in there now. `damping` = μ > 0.
  std::span<const double> Solve(std::span<const double> angles, std::span<const double> preferred,
                                std::span<const AngleRange> ranges, double damping);

  /// Tells whether the last answer is the optimum. Until it is, calls with the same arguments come nearer.
  bool is_exact() const { return is_exact_; }

 private:
  using Spatial = std::array<double, 6>;  // a turn, and a shift of the limb's point at the root R, both in W
  struct Quadratic {
    std::array<double, 36> matrix;  // Λ
    Spatial vector;                 // η
  };
  enum class Side : signed char { kLower, kFree, kUpper };
  struct Hinge {
    Spatial screw;     // s: movement per radian
    Spatial matrix_s;  // Λs, as it was before this hinge took its part
    double scale;      // 1 / (μ + sᵀΛs)
    double best;       // the best change while the limb before it rests
    double pull;       // the change that leads to the preferred angle
    double lower, upper;
    Side side = Side::kFree;
  };

  static double LineariseTarget(const EffectorTarget& target, const LimbFrame& X_WE, const glm::dvec3& p_WR,
                                Quadratic& out);
  void EliminateInwards(double damping);
  bool SubstituteOutwards();

  const KinematicTree& tree_;
  std::span<const EffectorTarget> targets_;
  std::vector<int> inwards_;                // `JointsInwards`
  std::unique_ptr<Hinge[]> hinges_;         // of each angle
  std::unique_ptr<Quadratic[]> effectors_;  // of each effector
  std::unique_ptr<Quadratic[]> limbs_;      // of each limb
  std::vector<Spatial> movements_;          // of each limb
  std::vector<double> change_;
  bool is_exact_ = false;
};

/// Returns the height of every joint: how many joints there are from it to the farthest leaf.
std::vector<int> JointHeights(const KinematicTree& tree);

/// Returns the joints without the root in the order of their heights, so that each comes after all beyond it and
/// neighbours are independent of each other.
std::vector<int> JointsInwards(const KinematicTree& tree);

}  // namespace etude
