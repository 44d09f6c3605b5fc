#include "engine/unmarked/adult_body.h"

#include <algorithm>
#include <array>
#include <cassert>

namespace etude {
namespace {

/// `adult` as thick as `body` is beside `average`: three bodies of the same pieces.
SilhouetteBody AsThick(SilhouetteBody adult, const SilhouetteBody& body, const SilhouetteBody& average) {
  assert(adult.flesh.size() == body.flesh.size() && body.flesh.size() == average.flesh.size());
  for (std::size_t i = 0; i < adult.flesh.size(); ++i) {
    adult.flesh[i].radius_a *= body.flesh[i].radius_a / average.flesh[i].radius_a;
    adult.flesh[i].radius_b *= body.flesh[i].radius_b / average.flesh[i].radius_b;
  }
  return adult;
}

}  // namespace

LimbLengths AdultLengths(double stature_m) {
  constexpr double kStature = 1.74;
  LimbLengths l;
  for (double* length : {&l.foot, &l.shank, &l.thigh, &l.hip_width, &l.trunk, &l.neck, &l.shoulder_width, &l.upper_arm,
                         &l.forearm, &l.hand}) {
    *length *= stature_m / kStature;
  }
  return l;
}

double FitStature(const SilhouetteBody& body, double stature_m, std::span<const PosedViews> moments,
                  const FitOptions& options) {
  constexpr std::array kScales = {0.94, 0.96, 0.98, 1.0, 1.02, 1.04, 1.06};
  const SilhouetteBody average = MakeSilhouetteBody(AdultLengths(stature_m));
  std::array<double, kScales.size()> costs{};
  FitWorkspace workspace;
  for (std::size_t i = 0; i < kScales.size(); ++i) {
    const SilhouetteBody adult = AsThick(MakeSilhouetteBody(AdultLengths(kScales[i] * stature_m)), body, average);
    for (const PosedViews& moment : moments) {
      costs[i] += FitSilhouettes(adult, moment.views, moment.state, nullptr, options, workspace).picture_cost;
    }
  }
  const auto best = static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin());
  if (best == 0 || best + 1 == kScales.size()) return kScales[best] * stature_m;
  // Where the parabola through the best and its neighbours is lowest.
  const double below = costs[best - 1] - costs[best], above = costs[best + 1] - costs[best];
  const double step = kScales[1] - kScales[0];
  const double shift = below + above > 0 ? 0.5 * step * (below - above) / (below + above) : 0;
  return (kScales[best] + shift) * stature_m;
}

}  // namespace etude
