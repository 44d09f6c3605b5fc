#pragma once

#include <span>
#include <vector>

#include "engine/kinematics/ik_problem.h"
#include "engine/kinematics/tree.h"

namespace etude {

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
