#include "sim/choreography/periodic_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

/// Returns the slope at a key from the steps before and after it (widths h, secants d).
double MonotoneSlope(double h_before, double d_before, double h_after, double d_after) {
  if (d_before * d_after <= 0) return 0;
  const double w_before = 2 * h_after + h_before, w_after = h_after + 2 * h_before;
  return (w_before + w_after) / (w_before / d_before + w_after / d_after);
}

double SmallerOfSameSign(double a, double b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

/// Tells whether the way starts and ends at rest.
bool IsBetweenRests(Ease ease) { return ease == Ease::kSnap || ease == Ease::kStep; }

/// Returns the share of the way's quintic that is reached after a share of its time. Where the curve does not rest at
/// both ends, the first two derivatives there must be those of the identity.
double Eased(Ease ease, double share) {
  // Zero up to the second derivative at both ends; up to 18.6 times it the sum below still rises everywhere.
  constexpr double kStrength = 8;
  const double hump = share * (1 - share), bulge = kStrength * hump * hump * hump;
  const auto within = [share](double from, double to) { return std::clamp((share - from) / (to - from), 0.0, 1.0); };
  switch (ease) {
    case Ease::kSmooth:
      return share;
    case Ease::kLinger:
      return share + bulge;
    case Ease::kRush:
      return share - bulge;
    case Ease::kSnap:
      return within(0.5, 1);
    case Ease::kStep:
      return within(0.2, 0.84);
  }
  return share;
}

}  // namespace

PeriodicCurve::PeriodicCurve(std::vector<Key> keys, double period) : period_(period) {
  assert(!keys.empty() && period > 0);
  const std::size_t count = keys.size();
  const auto width = [&](std::size_t i) {
    return i + 1 < count ? keys[i + 1].at - keys[i].at : keys[0].at + period - keys[i].at;
  };
  const auto secant = [&](std::size_t i) { return (keys[(i + 1) % count].value - keys[i].value) / width(i); };
  const auto rests = [&](std::size_t i) {
    return IsBetweenRests(keys[i].ease) || IsBetweenRests(keys[(i + 1) % count].ease);
  };

  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    double slope = rests(i) ? 0 : MonotoneSlope(width(before), secant(before), width(i), secant(i));
    if (keys[i].derivatives) slope = keys[i].derivatives->slope;
    knots_.push_back({keys[i].at, keys[i].value, slope, 0, keys[i].ease});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
    // Second derivatives of the cubic Hermite segments that end and start at this key.
    const double ending = (2 * knots_[before].slope + 4 * knots_[i].slope - 6 * secant(before)) / width(before);
    const double starting = (6 * secant(i) - 4 * knots_[i].slope - 2 * knots_[after].slope) / width(i);
    knots_[i].bend = rests(i) ? 0 : SmallerOfSameSign(ending, starting);
    if (keys[i].derivatives) knots_[i].bend = keys[i].derivatives->bend;
  }
  knots_.push_back(knots_.front());
  knots_.back().at += period;
}

double PeriodicCurve::At(double time) const {
  const double first = knots_.front().at;
  double at = first + std::fmod(time - first, period_);
  if (at < first) at += period_;
  const auto after = std::upper_bound(knots_.begin() + 1, knots_.end() - 1, at,
                                      [](double value, const Knot& knot) { return value < knot.at; });
  const Knot& from = *(after - 1);
  const Knot& to = *after;

  // Quintic Hermite: the curve relative to the start's own parabola, corrected to meet the end.
  const double h = to.at - from.at, s = Eased(to.ease, (at - from.at) / h);
  const double slope = from.slope * h, bend = from.bend * h * h;
  const double gap = to.value - from.value - slope - 0.5 * bend;
  const double slope_gap = to.slope * h - slope - bend;
  const double bend_gap = to.bend * h * h - bend;
  const double c3 = 10 * gap - 4 * slope_gap + 0.5 * bend_gap;
  const double c4 = -15 * gap + 7 * slope_gap - bend_gap;
  const double c5 = 6 * gap - 3 * slope_gap + 0.5 * bend_gap;
  return from.value + s * (slope + s * (0.5 * bend + s * (c3 + s * (c4 + s * c5))));
}

}  // namespace etude
