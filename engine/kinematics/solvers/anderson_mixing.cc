#include "engine/kinematics/solvers/anderson_mixing.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

// A difference of which less than this part is new adds rounding only.
constexpr double kNewPart = 1e-10;

double Dot(std::span<const double> a, std::span<const double> b) {
  double sums[4] = {};  // independent, so that additions overlap
  std::size_t i = 0;
  for (; i + 4 <= a.size(); i += 4) {
    for (int k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
  }
  for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

void AddMultiple(std::span<double> to, double factor, std::span<const double> of) {
  for (std::size_t i = 0; i < to.size(); ++i) to[i] += factor * of[i];
}

}  // namespace

AndersonMixing::AndersonMixing(int size, int memory)
    : memory_(memory),
      last_f_(size),
      last_g_(size),
      rest_(size),
      df_(memory, Vector(size)),
      dg_(memory, Vector(size)),
      basis_(memory, Vector(size)),
      parts_(memory, Vector(memory)),
      chosen_(memory),
      shares_(memory) {}

void AndersonMixing::Extrapolate(std::span<const double> x, std::span<const double> g, std::span<double> out) {
  RecordPair(x, g);
  std::ranges::copy(g, out.begin());

  // Gram–Schmidt, newest difference first: what f has along each new direction is taken off f at once, which keeps the
  // shares exact although directions are orthogonal to rounding only (Björck 1967).
  std::ranges::copy(last_f_, rest_.begin());
  int rank = 0;
  for (int i = 0; i < differences_; ++i) {
    Vector& direction = basis_[rank];
    direction = df_[i];
    for (int k = 0; k < rank; ++k) {
      parts_[rank][k] = Dot(basis_[k], direction);
      AddMultiple(direction, -parts_[rank][k], basis_[k]);
    }
    const double length = std::sqrt(Dot(direction, direction));
    if (!(length > kNewPart * std::sqrt(Dot(df_[i], df_[i])))) continue;
    for (double& entry : direction) entry /= length;
    parts_[rank][rank] = length;
    shares_[rank] = Dot(direction, rest_);
    AddMultiple(rest_, -shares_[rank], direction);
    chosen_[rank++] = i;
  }
  for (int r = rank - 1; r >= 0; --r) {
    shares_[r] /= parts_[r][r];
    for (int k = 0; k < r; ++k) shares_[k] -= shares_[r] * parts_[r][k];
    AddMultiple(out, -shares_[r], dg_[chosen_[r]]);
  }
}

// The newest pair, and how it differs from the one before.
void AndersonMixing::RecordPair(std::span<const double> x, std::span<const double> g) {
  if (has_last_ && memory_ > 0) {
    // The oldest difference makes room for the newest.
    std::rotate(df_.begin(), df_.end() - 1, df_.end());
    std::rotate(dg_.begin(), dg_.end() - 1, dg_.end());
    differences_ = std::min(differences_ + 1, memory_);
    for (std::size_t i = 0; i < g.size(); ++i) {
      df_[0][i] = (g[i] - x[i]) - last_f_[i];
      dg_[0][i] = g[i] - last_g_[i];
    }
  }
  for (std::size_t i = 0; i < g.size(); ++i) {
    last_f_[i] = g[i] - x[i];
    last_g_[i] = g[i];
  }
  has_last_ = true;
}

void AndersonMixing::Discard() {
  differences_ = 0;
  has_last_ = false;
}

}  // namespace etude
