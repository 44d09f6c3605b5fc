#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves like `SolveGaussNewton`, with the same answer to the last bit, in scalar code that is written for
/// readability. Read this version to understand the method; tests use it as the oracle for the fast versions. The trace
/// is filled if `IkOptions::trace` is set.
IkSolution SolveGaussNewtonPlainly(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                                   const GaussNewtonOptions& own = {});

/// Computes Gauss–Newton steps that lead towards targets and stay as near to a preferred posture as the targets allow.
/// A step is
///
///     argmin |J dq − e|² + μ |q + dq − q₀|²   subject to   lower ≤ q + dq ≤ upper,
///
/// with J the Jacobian of the targets, e their residuals (positions in units of 0.30 m, axes in radians), q₀ the
/// preferred posture and μ > 0 the damping. With a small μ, the second term matters only in the null space of J, where
/// the targets leave a choice.
///
/// J is never formed. As in Featherstone's articulated-body algorithm, the cost of all targets beyond a joint is one
/// quadratic function ½VᵀΛV − ηᵀV of the spatial movement V of the joint's limb (its rotation, and its translation at
/// the root). Elimination runs from the leaves inwards: where limbs join, their quadratics are added; a hinge with
/// screw s is eliminated by inserting its best angle for every V, which subtracts Λs(Λs)ᵀ / (μ + sᵀΛs) from Λ.
/// Substitution runs outwards from the root, which does not move, and yields the angles one by one. The cost is linear
/// in the number of hinges, for any tree and any number of effectors.
///
/// Bounds are kept by a primal-dual active set (Hintermüller, Ito and Kunisch 2002). During substitution every hinge
/// compares its best change, given the movement of its limb, with its range: if the change leads beyond an end, the
/// hinge is fixed at that end from the next call on; if a fixed hinge would move back inside, it is freed. Each call is
/// one such pass, inwards and outwards, so the set converges along with the steps, which needs fewer passes than a
/// complete active set in every step. The answer always lies within the ranges. It is the optimum if no hinge has
/// changed sides (`is_exact`): then the conditions of Karush, Kuhn and Tucker hold.
///
/// The constructor allocates all memory. `tree` and `targets` must outlive this object.
class GaussNewtonStep {
 public:
  GaussNewtonStep(const KinematicTree& tree, std::span<const EffectorTarget> targets);

  /// Linearises the targets at `frames`. Returns |e|².
  double Build(const TreeFrames& frames);

  /// Returns the change of every angle, radians. Angles must lie within `ranges`; the changed angles also do. `damping`
  /// = μ > 0.
  std::span<const double> Solve(std::span<const double> angles, std::span<const double> preferred,
                                std::span<const AngleRange> ranges, double damping);

  /// Returns true if the last answer is the optimum. If not, further calls with the same arguments converge to it.
  bool is_exact() const { return is_exact_; }

 private:
  // A rotation, then the translation of the limb's point at the root R, both in W.
  using Spatial = std::array<double, 6>;
  struct Quadratic {
    std::array<double, 36> matrix;  // Λ
    Spatial vector;                 // η
  };
  enum class Side : signed char { kLower, kFree, kUpper };
  struct Hinge {
    Spatial screw;     // s: movement per radian
    Spatial matrix_s;  // Λs before this hinge was eliminated
    double scale;      // 1 / (μ + sᵀΛs)
    double best;       // the best change if the limb before the hinge does not move
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
  std::vector<int> inwards_;                // the result of `JointsInwards`
  std::unique_ptr<Hinge[]> hinges_;         // one per angle
  std::unique_ptr<Quadratic[]> effectors_;  // one per effector
  std::unique_ptr<Quadratic[]> limbs_;      // one per limb
  std::vector<Spatial> movements_;          // one per limb
  std::vector<double> change_;
  bool is_exact_ = false;
};

}  // namespace etude
