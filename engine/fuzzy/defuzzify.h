#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "engine/fuzzy/membership.h"

namespace etude {

/// The four methods of defuzzification that paper A names (section 2.4). The paper gives no formulas, so the usual
/// formulas are used.
enum class Defuzzification {
  kMaximum,   ///< the mean of the inputs with maximum membership
  kCentroid,  ///< the centroid of the area under the terms' union; overlaps count once
  kHeight,    ///< the mean of the terms' peaks, weighted by the terms' grades
  kArea,      ///< the mean of the clipped terms' centres of gravity, weighted by area; overlaps count for each term
};

std::span<const Defuzzification, 4> AllDefuzzifications();
/// Returns "maximum", "centroid", "height" or "area".
std::string_view DefuzzificationName(Defuzzification method);

/// A term's shape, clipped at the grade to which the term is activated.
struct ActivatedTerm {
  Shape shape;
  double grade = 0;  ///< in [0, 1]
};

/// Returns the crisp value that represents the activated terms, within `universe`. Returns nullopt if no term is
/// activated within the universe. The result is exact for straight-sided shapes; areas of Gaussians are summed in
/// small steps (error below 1e-4 of the universe). Singletons have no area, so kCentroid and kArea ignore them unless
/// only singletons are activated; then the result is the mean of the singletons, weighted by their grades.
std::optional<double> Defuzzify(std::span<const ActivatedTerm> terms, const Universe& universe, Defuzzification method);

/// Returns the crisp value of a feature whose terms have these membership grades (see `Defuzzify`).
std::optional<double> DefuzzifyFeature(const Grades& grades, Feature feature, const Memberships& memberships,
                                       Defuzzification method);

}  // namespace etude
