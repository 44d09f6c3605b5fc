#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

/// Solves by cyclic coordinate descent as paper B describes it (sections 3.6 and 3.7): `IkOptions` chooses joint
/// limits, angle-change tolerance and weights. One iteration is one sweep over all joints, one forward-kinematics pass.
IkSolution SolveCcd(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// Solves as `SolveCcd` does, with every joint of two or three degrees of freedom treated as a row of hinges. *Ours.*
IkSolution SolveCcdHinges(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options);

/// The gain of a hinge: how well the end effectors below it meet their targets after turning it by φ (paper B,
/// equations 3.10–3.13): g(φ) = k₁(1 − cos φ) + k₂ cos φ + k₃ sin φ, to be maximal. Sums of several effectors are ours.
/// For axes the paper sets out from Σ (u_d · u_c − 1)² and then makes Σ u_d · u_c largest, which is not the same for
/// three of them; the latter is meant here, and makes Σ |u_d − u_c|² least.
struct HingeGain {
  double k1 = 0, k2 = 0, k3 = 0;

  /// Adds one pair of vectors, current and desired, both from the joint: a position of the effector
  /// or one of its axes. All in one frame; `axis` is the hinge's, of unit length.
  void Add(double weight, const glm::dvec3& current, const glm::dvec3& desired, const glm::dvec3& axis) {
    k1 += weight * (glm::dot(desired, axis) * glm::dot(current, axis));
    k2 += weight * glm::dot(desired, current);
    k3 += weight * glm::dot(axis, glm::cross(current, desired));
  }

  double At(double phi) const;

  /// Returns the φ in (−π, π] where g is maximal; 0 when g is flat.
  double Optimum() const;

  /// Returns the best φ within `range`, which holds 0 (so a turn by nothing is always allowed). The optimum counts
  /// modulo 2π; when it is outside, the end of the range with the larger g, the lower one on a tie.
  double OptimumWithin(const AngleRange& range) const;
};

/// The way in which a joint of two or three degrees of freedom is turned.
enum class CcdJoint {
  kWhole,   ///< paper B, case 2: turn about each axis of the joint's rest frame in turn; after each turn take the
            ///< joint's whole rotation apart into Rx Ry Rz, clip the angles, put it together again
  kHinges,  ///< ours: as hinges about its Euler axes, each clipped at once, which never makes the gain smaller
};

/// Cyclic coordinate descent on a tree (paper B, section 3.6), sweep by sweep. Takes its memory when made; `Sweep`
/// allocates nothing. `tree` and `problem` must be free of faults (`FindFault`) and outlive this.
class CcdSweep {
 public:
  CcdSweep(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options, CcdJoint joint_kind);

  /// Turns every joint once, leaves to root: a joint after all its children (figure 3.10). Returns the largest change
  /// of an angle, radians.
  double Sweep();

  /// The two halves of `Sweep`: `Turn` finds new angles, `Measure` the errors that they lead to.
  double Turn();
  void Measure();

  /// Returns what turns lower: Σ w_p e² + Σ w_o |u_c − u_d|² of the pose measured last, by the weights of the last turn
  /// (by those it ended with when they change on the way; `kWangChen` without ρ).
  double Merit() const;
  /// Sets every angle, or the nearest end of its range. Measures nothing.
  void SetAngles(std::span<const double> angles);

  std::span<const double> angles() const { return state_.angles; }
  /// The errors of the present angles, as forward kinematics gives them.
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
  std::vector<std::vector<int>> effectors_below_;  // of each joint
  TreeState state_;
  TreeFrames frames_;  // effectors are kept current while the joints below have turned, nothing else is
  std::vector<EffectorError> errors_;
  std::vector<EffectorWeights> weights_;
};

struct CcdAndersonOptions {
  /// The number of former sweeps that the extrapolation uses. Five: of 200 starts off by 15° (poses of the joints'
  /// whole ranges) it solves 97 % to 10⁻³ cm and 10⁻³° in 186 sweeps on average; one solves 55 % in 707, three 96.5 %
  /// in 198, twelve 98 % in 154. Raise it where a sweep costs much more than mixing, which grows with its square.
  int memory = 5;
};

/// Solves by the sweeps of `ccd-hinges`, extrapolated from the last of them (`AndersonMixing`). *Ours.* Paper B settles
/// one joint after the other, so that errors creep along the limbs, which can be extrapolated. An angle enters as x =
/// tan((q − middle of its range) / 2), which costs no trigonometry. An extrapolation that raises Σ w_p e² + Σ w_o |u_c
/// − u_d|², by the weights of its sweep, is dropped for what the sweep itself found. One iteration is one sweep; it
/// costs one forward-kinematics pass, or two when its extrapolation was dropped.
IkSolution SolveCcdAnderson(const KinematicTree& tree, const IkProblem& problem, const IkOptions& options,
                            const CcdAndersonOptions& own = {});

/// Anderson's extrapolation of a fixed-point iteration x ← g(x) (Anderson 1965; "type II" of Walker and Ni 2011). From
/// the last pairs of x and g(x), with f = g(x) − x, it takes
///     g − Σ γ_i Δg_i,   γ = argmin |f − Σ γ_i Δf_i|,
/// Δ being differences of neighbouring pairs: where g is linear, the point of their span whose f is shortest. Takes
/// its memory when made.
class AndersonMixing {
 public:
  /// Makes one for vectors of `size` numbers, looking back by `memory` ≥ 0 pairs.
  AndersonMixing(int size, int memory);

  /// Records the pair x, g = g(x) and writes the extrapolation to `out`; g itself when no pair came before.
  void Extrapolate(std::span<const double> x, std::span<const double> g, std::span<double> out);

  /// Discards all pairs: to be called after a jump that g did not make.
  void Discard();

 private:
  using Vector = std::vector<double>;

  void RecordPair(std::span<const double> x, std::span<const double> g);

  const int memory_;
  bool has_last_ = false;
  int differences_ = 0;          // known so far, at most `memory_`
  Vector last_f_, last_g_;       // of the last pair
  Vector rest_;                  // f without what it has along the basis
  std::vector<Vector> df_, dg_;  // differences, newest first
  std::vector<Vector> basis_;    // orthonormal, of those df that are independent of newer ones
  std::vector<Vector> parts_;    // df_[chosen_[r]] = Σ_k parts_[r][k] · basis_[k]
  std::vector<int> chosen_;
  Vector shares_;  // γ of the chosen ones
};

}  // namespace etude
