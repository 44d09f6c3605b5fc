#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves by cyclic coordinate descent as paper B describes it (sections 3.6 and 3.7). `IkOptions` selects joint
/// limits, angle-change tolerance and weights. One iteration is one sweep over all joints and costs one
/// forward-kinematics pass.
IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// Solves like `SolveCcd`, but treats a joint of two or three degrees of freedom as a sequence of hinges. *Ours.*
IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// The gain g(φ) = k₁(1 − cos φ) + k₂ cos φ + k₃ sin φ of a hinge that turns by φ (paper B, equations 3.10–3.13). The
/// gain measures how well the end effectors beyond the hinge match their targets after the turn; the best turn
/// maximises the gain. Summing over several effectors is ours. Let u_c be the current and u_d the desired unit vector
/// of an axis. For axes, the paper starts from minimising Σ (u_d · u_c − 1)² but then maximises Σ u_d · u_c; for
/// three axes, these criteria differ. This struct maximises Σ u_d · u_c, which minimises Σ |u_d − u_c|².
struct HingeGain {
  double k1 = 0, k2 = 0, k3 = 0;

  /// Adds one pair of vectors, current and desired: either positions of the effector relative to the joint, or one of
  /// the effector's axes. All vectors are in the same frame; `axis` is the hinge's unit axis.
  void Add(double weight, const glm::dvec3& current, const glm::dvec3& desired, const glm::dvec3& axis) {
    k1 += weight * (glm::dot(desired, axis) * glm::dot(current, axis));
    k2 += weight * glm::dot(desired, current);
    k3 += weight * glm::dot(axis, glm::cross(current, desired));
  }

  /// Returns g(φ), φ in radians.
  double At(double phi) const;

  /// Returns the φ in (−π, π] that maximises g; 0 if g is constant.
  double Optimum() const;

  /// Returns the best φ within `range`, which must contain 0, so that keeping the angle is always allowed. The optimum
  /// is taken modulo 2π. If the optimum is outside `range`, returns the end of the range with the larger g, or the
  /// lower end if g is equal at the two ends.
  double OptimumWithin(const AngleRange& range) const;
};

/// The way in which a joint of two or three degrees of freedom is turned.
enum class CcdJoint {
  /// Paper B, case 2: rotate about the axes of the joint's rest frame, one after the other. After each rotation,
  /// decompose the joint's whole rotation into Rx Ry Rz, clip the angles, and compose it again.
  kWhole,
  /// Ours: turn the joint as hinges about its Euler axes, each clipped immediately. No turn of a hinge lowers its
  /// `HingeGain`.
  kHinges,
};

/// Cyclic coordinate descent on a tree (paper B, section 3.6), one sweep per call. The constructor allocates all
/// memory; `Sweep` allocates nothing. `tree` and `problem` must be free of faults (`FindFault`) and outlive this
/// object.
class CcdSweep {
 public:
  CcdSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind);

  /// Turns every joint once, from the leaves to the root (paper B, figure 3.10): a joint after all its children.
  /// Returns the largest change of an angle, radians.
  double Sweep();

  /// The two halves of `Sweep`: `Turn` computes new angles, `Measure` computes the frames and errors at these angles.
  double Turn();
  void Measure();

  /// Returns the sum that turns reduce, Σ w_p e² + Σ w_o |u_c − u_d|², at the pose measured last, with the weights of
  /// the last turn. If weights change during a sweep, the weights at the sweep's end are used. For `kWangChen`, the
  /// factor 1 + ρ (`WangChenFactor`) is left out.
  double Merit() const;
  /// Sets every angle, clamped to its range. Does not update the errors.
  void SetAngles(std::span<const double> angles);

  std::span<const double> angles() const { return state_.angles; }
  /// Returns the errors at the pose measured last.
  std::span<const EffectorError> errors() const { return errors_; }

 private:
  void UpdateWeightsBelow(int joint);
  HingeGain GainAbout(const glm::dvec3& axis_W, int joint) const;
  void TurnBelow(int joint, const glm::dmat3& rotation);
  double TurnHinge(int joint, int axis);
  double TurnAsHinges(int joint);
  double TurnWhole(int joint);

  const KinematicTree& tree_;
  const IkProblem& problem_;
  const IkOptions options_;
  const CcdJoint joint_kind_;
  const std::vector<AngleRange> ranges_;
  std::vector<std::vector<int>> effectors_below_;  // for each joint: the effectors beyond it
  TreeState state_;
  TreeFrames frames_;  // during a sweep, only the frames of effectors are up to date
  std::vector<EffectorError> errors_;
  std::vector<EffectorWeights> weights_;
};

struct CcdAndersonOptions {
  /// The number of earlier sweeps that the extrapolation uses. The default solves nearly as many problems as larger
  /// values, in slightly more sweeps (README.md has the figures). Raise it if a sweep is much more expensive than the
  /// extrapolation, whose cost grows with the square of this number.
  int memory = 5;
};

/// Solves by the sweeps of `ccd-hinges`, extrapolated from the last few sweeps (`AndersonMixing`). *Ours.* In paper B
/// one joint is optimised after the other, so errors move slowly along the limbs; such slow convergence can be
/// extrapolated. Instead of each angle q, x = tan((q − middle of its range) / 2) is extrapolated, because sine and
/// cosine of q follow from x without trigonometric functions. If an extrapolation raises Σ w_p e² + Σ w_o |u_c − u_d|²
/// (with the weights of its sweep), it is discarded and the result of the sweep is kept. One iteration is one sweep; it
/// costs one forward-kinematics pass, or two if its extrapolation was discarded.
IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const CcdAndersonOptions& own = {});

/// Anderson's extrapolation of a fixed-point iteration x ← g(x) (Anderson 1965; "type II" of Walker and Ni 2011). With
/// f = g(x) − x and Δ the differences of consecutive pairs, the extrapolated point is
///     g − Σ γ_i Δg_i,   γ = argmin |f − Σ γ_i Δf_i|.
/// If g is linear, this is the point in the affine span of the pairs at which f is shortest. The constructor allocates
/// all memory.
class AndersonMixing {
 public:
  /// Makes an extrapolation for vectors of `size` numbers that uses the last `memory` ≥ 0 pairs.
  AndersonMixing(int size, int memory);

  /// Records the pair x, g = g(x) and writes the extrapolation to `out`. After the first pair, `out` is g.
  void Extrapolate(std::span<const double> x, std::span<const double> g, std::span<double> out);

  /// Forgets all pairs. Call it after x has been changed by anything other than g.
  void Discard();

 private:
  using Vector = std::vector<double>;

  void RecordPair(std::span<const double> x, std::span<const double> g);

  const int memory_;
  bool has_last_ = false;
  int differences_ = 0;          // number of stored differences, at most `memory_`
  Vector last_f_, last_g_;       // f and g of the pair recorded last
  Vector rest_;                  // the part of f that is orthogonal to the basis
  std::vector<Vector> df_, dg_;  // the differences Δf and Δg, newest first
  std::vector<Vector> basis_;    // orthonormal basis of the df that do not depend linearly on newer df
  std::vector<Vector> parts_;    // df_[chosen_[r]] = Σ_k parts_[r][k] · basis_[k]
  std::vector<int> chosen_;
  Vector shares_;  // γ of the chosen differences
};

}  // namespace etude
