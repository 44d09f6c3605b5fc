#include "sim/choreography/periodic_curve.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

/// The slope at a key from the steps before and after it (widths h, secants d).
double MonotoneSlope(double h_before, double d_before, double h_after, double d_after) {
  if (d_before * d_after <= 0) return 0;
  const double w_before = 2 * h_after + h_before, w_after = h_after + 2 * h_before;
  return (w_before + w_after) / (w_before / d_before + w_after / d_after);
}

double SmallerOfSameSign(double a, double b) {
  if (a * b <= 0) return 0;
  return std::abs(a) < std::abs(b) ? a : b;
}

}  // namespace

PeriodicCurve::PeriodicCurve(std::vector<Key> keys, double period) : period_(period) {
  assert(!keys.empty() && period > 0);
  const std::size_t count = keys.size();
  const auto width = [&](std::size_t i) {
    return i + 1 < count ? keys[i + 1].at - keys[i].at : keys[0].at + period - keys[i].at;
  };
  const auto secant = [&](std::size_t i) { return (keys[(i + 1) % count].value - keys[i].value) / width(i); };

  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count;
    knots_.push_back({keys[i].at, keys[i].value, MonotoneSlope(width(before), secant(before), width(i), secant(i)), 0});
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t before = (i + count - 1) % count, after = (i + 1) % count;
    // Second derivatives of the cubic Hermite segments that end and start at this key.
    const double ending = (2 * knots_[before].slope + 4 * knots_[i].slope - 6 * secant(before)) / width(before);
    const double starting = (6 * secant(i) - 4 * knots_[i].slope - 2 * knots_[after].slope) / width(i);
    knots_[i].bend = SmallerOfSameSign(ending, starting);
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
  const double h = to.at - from.at, s = (at - from.at) / h;
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
