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

/// The shapes of membership functions that paper A names (section 2.4, figure 1). Inputs in the feature's unit.
struct Triangular {
  double left, peak, right;  ///< 0 up to `left`, 1 at `peak`, 0 from `right`; rising, equal where a side is upright
};
struct Trapezoidal {
  double left, left_top, right_top, right;  ///< 0 up to `left`, 1 between the tops, 0 from `right`; rising
};
struct Gaussian {
  double mean, sigma;  ///< exp(−(x − mean)² / 2 sigma²), sigma > 0
};
struct Singleton {
  double at;  ///< 1 there, 0 elsewhere
};
using Shape = std::variant<Triangular, Trapezoidal, Gaussian, Singleton>;

/// The grade of membership of an input, in [0, 1].
double GradeOf(const Shape& shape, double input);

struct Cut {
  double low = 0, high = 0;  ///< closed
};

/// The α-cut: the inputs of at least this grade, in (0, 1]. One interval, since every shape is convex. Grade 0 gives
/// the support of a shape with straight sides.
Cut CutOf(const Shape& shape, double grade);

/// A linguistic term of a feature (table 1 of paper A): "down", "true", "stand", …
struct Term {
  Feature feature;
  std::string_view name;
};

constexpr std::size_t kTermCount = 24;

/// Paper A's terms, grouped by feature in the order of `AllFeatures`.
std::span<const Term, kTermCount> AllTerms();
/// The terms of one feature, in the paper's order, and where they start in `AllTerms`.
std::span<const Term> TermsOf(Feature feature);
std::size_t FirstTermOf(Feature feature);

/// The inputs that a feature can have; others are clamped to them.
struct Universe {
  double low = 0, high = 180;
};

/// The membership function of every term.
struct Memberships {
  std::array<Universe, kFeatureCount> universes{};
  std::array<Shape, kTermCount> shapes{};  ///< in the order of `AllTerms`
};

/// Returns equations 2–16, as scenarios/fuzzy/paper.yaml holds them. Elbow, trunk and knee grades do not sum to 1: so
/// printed, so kept.
const Memberships& PaperMemberships();

/// The grades to which a pose belongs to each of the 24 terms, in the order of `AllTerms`.
using Grades = std::array<double, kTermCount>;
Grades Fuzzify(const PoseFeatures& features, const Memberships& memberships = PaperMemberships());

/// One term per feature, as its place in `TermsOf`.
using Tags = std::array<std::uint8_t, kFeatureCount>;
/// The term of maximum membership of each feature; the earlier one on a tie.
Tags ChooseTags(const Grades& grades);
std::string_view TagName(const Tags& tags, Feature feature);

/// Reads `{triangular: [20, 90, 180]}`, `{trapezoidal: [0, 0, 20, 90]}`, `{gaussian: [90, 25]}` or `{singleton: 90}`.
/// Refused: breakpoints out of order, sigma that is not positive, and a shape whose top no input of `universe` reaches.
Result<Shape> ReadShape(const Node& node, const Universe& universe);

/// Writes a shape as ReadShape reads it back, to the last bit.
std::string WriteShape(const Shape& shape);

}  // namespace etude
