#include "engine/fuzzy/defuzzify.h"

#include <algorithm>
#include <vector>

namespace etude {
namespace {

using enum Defuzzification;
constexpr std::array<Defuzzification, 4> kMethods = {kMaximum, kCentroid, kHeight, kArea};
constexpr std::array<std::string_view, 4> kNames = {"maximum", "centroid", "height", "area"};

/// The sums from which a weighted mean is computed.
struct Moment {
  double weight = 0, sum = 0;

  void Add(double share, double at) {
    weight += share;
    sum += share * at;
  }
  std::optional<double> Mean() const { return weight > 0 ? std::optional(sum / weight) : std::nullopt; }
};

double ClippedAt(const ActivatedTerm& term, double x) { return std::min(term.grade, GradeOf(term.shape, x)); }

/// Returns the intersection of a cut and the universe; low > high if they do not overlap.
Cut Within(const Universe& universe, const Cut& cut) {
  return {std::max(cut.low, universe.low), std::min(cut.high, universe.high)};
}

/// Returns the input at which the term's grade, before clipping, is largest (the middle of its top).
double PeakOf(const Shape& shape, const Universe& universe) {
  const Cut top = Within(universe, CutOf(shape, 1));
  return 0.5 * (top.low + top.high);
}

std::optional<double> MeanOfMaxima(std::span<const ActivatedTerm> terms, const Universe& universe) {
  double highest = 0;
  for (const ActivatedTerm& term : terms) highest = std::max(highest, term.grade);
  std::vector<Cut> maxima;
  for (const ActivatedTerm& term : terms) {
    if (term.grade == highest) maxima.push_back(Within(universe, CutOf(term.shape, highest)));
  }
  std::ranges::sort(maxima,
                    [](const Cut& a, const Cut& b) { return a.low != b.low ? a.low < b.low : a.high < b.high; });
  Moment lengths, points;
  double covered = universe.low;
  for (const Cut& cut : maxima) {
    const double low = std::max(cut.low, covered);  // an overlap of two terms counts once
    if (cut.high > low) lengths.Add(cut.high - low, 0.5 * (low + cut.high));
    points.Add(1, 0.5 * (cut.low + cut.high));
    covered = std::max(covered, cut.high);
  }
  return lengths.weight > 0 ? lengths.Mean() : points.Mean();
}

/// Adds the inputs at which a straight-sided term has a corner; for a Gaussian, adds inputs in small steps.
void AddCorners(const ActivatedTerm& term, const Universe& universe, std::vector<double>& corners) {
  for (double grade : {1.0, term.grade}) {
    const Cut cut = CutOf(term.shape, grade);
    corners.insert(corners.end(), {cut.low, cut.high});
  }
  if (const auto* gaussian = std::get_if<Gaussian>(&term.shape)) {
    constexpr int kSteps = 128;
    // Distance from the mean in standard deviations; farther away, the grade is below 1e-13.
    constexpr double kReach = 8;
    for (int i = 0; i <= kSteps; ++i) {
      corners.push_back(gaussian->mean + gaussian->sigma * kReach * (2.0 * i / kSteps - 1));
    }
  } else if (!std::holds_alternative<Singleton>(term.shape)) {
    const Cut support = CutOf(term.shape, 0);
    corners.insert(corners.end(), {support.low, support.high});
  }
  std::erase_if(corners, [&](double x) { return x <= universe.low || x >= universe.high; });
}

/// Returns the inputs at which the union of the terms may have a corner: corners of terms and crossings of two terms.
std::vector<double> CornersOf(std::span<const ActivatedTerm> terms, const Universe& universe) {
  std::vector<double> corners;
  for (const ActivatedTerm& term : terms) AddCorners(term, universe, corners);
  corners.insert(corners.end(), {universe.low, universe.high});
  std::ranges::sort(corners);
  std::vector<double> all = corners;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    // Between two neighbouring corners every term is a straight line (a Gaussian is nearly straight), so each pair of
    // terms crosses at most once.
    const double low = corners[i], high = corners[i + 1];
    if (high <= low) continue;
    for (std::size_t a = 0; a < terms.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const double at_low = ClippedAt(terms[a], low) - ClippedAt(terms[b], low);
        const double at_high = ClippedAt(terms[a], high) - ClippedAt(terms[b], high);
        if (at_low * at_high < 0) all.push_back(low + (high - low) * at_low / (at_low - at_high));
      }
    }
  }
  std::ranges::sort(all);
  return all;
}

/// Returns the area and the first moment of the union of the terms, by Simpson's rule between corners. The rule is
/// exact for straight lines.
Moment AreaUnder(std::span<const ActivatedTerm> terms, const Universe& universe) {
  const auto height = [&](double x) {
    double highest = 0;
    for (const ActivatedTerm& term : terms) highest = std::max(highest, ClippedAt(term, x));
    return highest;
  };
  const std::vector<double> corners = CornersOf(terms, universe);
  Moment area;
  for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
    const double low = corners[i], high = corners[i + 1], middle = 0.5 * (low + high);
    // At a vertical side the curve has two values, so sample slightly inside the interval.
    const double inset = (high - low) * 1e-9;
    const double at_low = height(low + inset), at_middle = height(middle), at_high = height(high - inset);
    area.weight += (high - low) / 6 * (at_low + 4 * at_middle + at_high);
    area.sum += (high - low) / 6 * (at_low * low + 4 * at_middle * middle + at_high * high);
  }
  return area;
}

Moment HeightOf(std::span<const ActivatedTerm> terms, const Universe& universe) {
  Moment heights;
  for (const ActivatedTerm& term : terms) heights.Add(term.grade, PeakOf(term.shape, universe));
  return heights;
}

}  // namespace

std::span<const Defuzzification, 4> AllDefuzzifications() { return kMethods; }

std::string_view DefuzzificationName(Defuzzification method) { return kNames[static_cast<std::size_t>(method)]; }

std::optional<double> Defuzzify(std::span<const ActivatedTerm> terms, const Universe& universe,
                                Defuzzification method) {
  std::vector<ActivatedTerm> active;
  std::vector<ActivatedTerm> wide;  // activated terms that have an area (no singletons)
  for (const ActivatedTerm& term : terms) {
    const Cut top = Within(universe, CutOf(term.shape, 1));
    if (term.grade <= 0 || top.low > top.high) continue;
    active.push_back(term);
    if (!std::holds_alternative<Singleton>(term.shape)) wide.push_back(term);
  }
  if (active.empty()) return std::nullopt;
  if (method == kMaximum) return MeanOfMaxima(active, universe);
  Moment moment;
  if (method == kCentroid) moment = AreaUnder(wide, universe);
  if (method == kArea) {
    for (const ActivatedTerm& term : wide) {
      const Moment own = AreaUnder(std::span(&term, 1), universe);
      moment.weight += own.weight;
      moment.sum += own.sum;
    }
  }
  if (moment.weight == 0) moment = HeightOf(active, universe);
  return moment.Mean();
}

std::optional<double> DefuzzifyFeature(const Grades& grades, Feature feature, const Memberships& memberships,
                                       Defuzzification method) {
  std::vector<ActivatedTerm> terms;
  for (std::size_t i = FirstTermOf(feature); i < FirstTermOf(feature) + TermsOf(feature).size(); ++i) {
    terms.push_back({memberships.shapes[i], grades[i]});
  }
  return Defuzzify(terms, memberships.universes[static_cast<std::size_t>(feature)], method);
}

}  // namespace etude
