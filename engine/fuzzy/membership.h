#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "engine/base/result.h"
#include "engine/fuzzy/features.h"

namespace etude {

struct Node;

/// The shapes of membership functions that paper A names (section 2.4, figure 1). Inputs have the feature's unit.
struct Triangular {
  /// The grade is 0 up to `left`, 1 at `peak`, 0 from `right`; left ≤ peak ≤ right; two of these are equal if the side
  /// between them is vertical.
  double left, peak, right;
};
struct Trapezoidal {
  /// The grade is 0 up to `left`, 1 between the tops, 0 from `right`; the four are in ascending order.
  double left, left_top, right_top, right;
};
struct Gaussian {
  double mean, sigma;  ///< the grade is exp(−(x − mean)² / 2 sigma²), sigma > 0
};
struct Singleton {
  double at;  ///< the grade is 1 at this input, 0 elsewhere
};
using Shape = std::variant<Triangular, Trapezoidal, Gaussian, Singleton>;

/// Returns the membership grade of an input, in [0, 1].
double GradeOf(const Shape& shape, double input);

struct Cut {
  double low = 0, high = 0;  ///< limits of the closed interval
};

/// Returns the α-cut for a grade in (0, 1]: the set of inputs whose grade is at least `grade`. It is one interval,
/// because every shape is convex. For grade 0, it returns the support of a straight-sided shape.
Cut CutOf(const Shape& shape, double grade);

/// A linguistic term of a feature (table 1 of paper A), for example "down", "true" or "stand".
struct Term {
  Feature feature;
  std::string_view name;
};

constexpr std::size_t kTermCount = 24;

/// Returns paper A's terms, grouped by feature in the order of `AllFeatures`.
std::span<const Term, kTermCount> AllTerms();
/// TermsOf returns the terms of one feature in the paper's order; FirstTermOf returns the index of a feature's first
/// term in `AllTerms`.
std::span<const Term> TermsOf(Feature feature);
std::size_t FirstTermOf(Feature feature);

/// The range of a feature's inputs; inputs outside are clamped to it.
struct Universe {
  double low = 0, high = 180;
};

/// The membership functions of all terms.
struct Memberships {
  std::array<Universe, kFeatureCount> universes{};
  std::array<Shape, kTermCount> shapes{};  ///< the shape of each term, in the order of `AllTerms`
};

/// Returns the membership functions of equations 2–16, as in scenarios/fuzzy/paper.yaml. As printed in the paper, the
/// grades of elbows, trunk and knees do not sum to 1.
const Memberships& PaperMemberships();

/// The membership grades of a pose in the 24 terms, in the order of `AllTerms`.
using Grades = std::array<double, kTermCount>;
Grades Fuzzify(const PoseFeatures& features, const Memberships& memberships = PaperMemberships());

/// One term per feature, as an index in `TermsOf`.
using Tags = std::array<std::uint8_t, kFeatureCount>;
/// Returns each feature's term of maximum membership, the earlier one on a tie.
Tags ChooseTags(const Grades& grades);
std::string_view TagName(const Tags& tags, Feature feature);

/// Reads `{triangular: [20, 90, 180]}`, `{trapezoidal: [0, 0, 20, 90]}`, `{gaussian: [90, 25]}` or `{singleton: 90}`.
/// Returns an error if breakpoints are out of order, if sigma is not positive, or if the top lies outside `universe`.
Result<Shape> ReadShape(const Node& node, const Universe& universe);

/// Returns the text from which ReadShape reads the same shape, bit for bit.
std::string WriteShape(const Shape& shape);

}  // namespace etude
