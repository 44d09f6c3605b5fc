#include "bench/training/membership_genes.h"

#include <algorithm>
#include <cassert>

namespace etude {
namespace {

using enum Feature;
/// Features and, for limbs, what is tuned along with them.
constexpr Feature kTuned[][2] = {{kRH, kLH},       {kRHE, kLHE}, {kPosture, kPosture},
                                 {kTrunk, kTrunk}, {kRF, kLF},   {kRFK, kLFK}};

/// The breakpoints of a shape, rising; none of shapes that have none.
std::vector<double> BreakpointsOf(const Shape& shape) {
  if (const auto* triangle = std::get_if<Triangular>(&shape)) return {triangle->left, triangle->peak, triangle->right};
  if (const auto* top = std::get_if<Trapezoidal>(&shape)) {
    return {top->left, top->left_top, top->right_top, top->right};
  }
  return {};
}

Shape WithBreakpoints(const Shape& shape, const std::vector<double>& at) {
  if (at.size() == 3) return Triangular{at[0], at[1], at[2]};
  if (at.size() == 4) return Trapezoidal{at[0], at[1], at[2], at[3]};
  return shape;
}

bool IsWithin(double breakpoint, const Universe& universe) {
  return breakpoint > universe.low && breakpoint < universe.high;
}

}  // namespace

std::size_t CountMembershipGenes(const Memberships& start) {
  std::size_t count = 0;
  for (const auto& [feature, twin] : kTuned) {
    const Universe& universe = start.universes[static_cast<std::size_t>(feature)];
    for (std::size_t term = 0; term < TermsOf(feature).size(); ++term) {
      for (double breakpoint : BreakpointsOf(start.shapes[FirstTermOf(feature) + term])) {
        count += IsWithin(breakpoint, universe);
      }
    }
  }
  return count;
}

Memberships MembershipsOfGenes(const Memberships& start, std::span<const double> genes) {
  assert(genes.size() == CountMembershipGenes(start));
  Memberships tuned = start;
  std::size_t gene = 0;
  for (const auto& [feature, twin] : kTuned) {
    const Universe& universe = start.universes[static_cast<std::size_t>(feature)];
    const double reach = kBreakpointReach * (universe.high - universe.low);
    for (std::size_t term = 0; term < TermsOf(feature).size(); ++term) {
      const Shape& shape = start.shapes[FirstTermOf(feature) + term];
      std::vector<double> breakpoints = BreakpointsOf(shape);
      for (double& breakpoint : breakpoints) {
        if (!IsWithin(breakpoint, universe)) continue;
        breakpoint = std::clamp(breakpoint + (2 * genes[gene++] - 1) * reach, universe.low, universe.high);
      }
      std::sort(breakpoints.begin(), breakpoints.end());
      const Shape moved = WithBreakpoints(shape, breakpoints);
      tuned.shapes[FirstTermOf(feature) + term] = moved;
      tuned.shapes[FirstTermOf(twin) + term] = moved;
    }
  }
  return tuned;
}

}  // namespace etude
