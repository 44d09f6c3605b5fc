#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>

#include "engine/fuzzy/membership.h"

namespace etude {

/// The four ways back from grades to a number that paper A names (section 2.4). It gives no formulas; these are the
/// usual ones.
enum class Defuzzification {
  kMaximum,   ///< the mean of the inputs of maximum membership
  kCentroid,  ///< the centre of gravity of the area under the union of the terms; overlaps count once
  kHeight,    ///< the mean of the terms' peaks, weighted by their grades
  kArea,      ///< the mean of the clipped terms' own centres of gravity, weighted by their areas; overlaps count twice
};

std::span<const Defuzzification, 4> AllDefuzzifications();
/// Returns "maximum", "centroid", "height", "area".
std::string_view DefuzzificationName(Defuzzification method);

/// A term's shape, cut off at the grade to which it is activated.
struct ActivatedTerm {
  Shape shape;
  double grade = 0;  ///< in [0, 1]
};

/// The crisp input that activated terms speak for, within `universe`. Nothing when no term is activated, or none within
/// the universe. Exact for straight-sided shapes; under a Gaussian, areas are summed in small steps (error below 1e-4
/// of the universe). Singletons have no area: they count in centroid and area only where nothing has one, by their
/// grades.
std::optional<double> Defuzzify(std::span<const ActivatedTerm> terms, const Universe& universe, Defuzzification method);

/// A feature's own grades turned back to its input.
std::optional<double> DefuzzifyFeature(const Grades& grades, Feature feature, const Memberships& memberships,
                                       Defuzzification method);

}  // namespace etude
