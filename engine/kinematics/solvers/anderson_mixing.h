#pragma once

#include <span>
#include <vector>

namespace etude {

/// Anderson's extrapolation of a fixed-point iteration x ← g(x) (Anderson 1965; "type II" of Walker and Ni 2011). From
/// the last pairs of x and g(x), with f = g(x) − x, it takes
///     g − Σ γ_i Δg_i,   γ = argmin |f − Σ γ_i Δf_i|,
/// Δ being differences of neighbouring pairs: where g is linear, the point of their span whose f is shortest. Takes
/// its memory when made.
class AndersonMixing {
 public:
  /// For vectors of `size` numbers, looking back by `memory` ≥ 0 pairs.
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
