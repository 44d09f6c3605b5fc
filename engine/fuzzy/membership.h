#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/fuzzy/features.h"

namespace etude {

/// One corner of a piecewise linear membership function.
struct Breakpoint {
  double input;  ///< in the feature's unit: degrees, or Posture's height with standing = 80
  double grade;  ///< in [0, 1]
};

/// A linguistic term of a feature: "down", "true", "stand", …
struct Term {
  Feature feature;
  std::string_view name;
  std::span<const Breakpoint> shape;  ///< inputs rising
};

constexpr std::size_t kTermCount = 24;

/// Paper A's terms with the shapes of its equations 2–16, grouped by feature in the order of
/// `AllFeatures`. Elbow, trunk and knee grades do not sum to 1: so printed, so kept.
std::span<const Term, kTermCount> AllTerms();
/// The terms of one feature, in the paper's order, and where they start in `AllTerms`.
std::span<const Term> TermsOf(Feature feature);
std::size_t FirstTermOf(Feature feature);

/// The grade of membership: linear between breakpoints, constant outside the first and the last.
double MembershipGrade(std::span<const Breakpoint> shape, double input);

/// How far a pose belongs to each of the 24 terms, in the order of `AllTerms`.
using Grades = std::array<double, kTermCount>;
Grades Fuzzify(const PoseFeatures& features);

/// One term per feature, as its place in `TermsOf`.
using Tags = std::array<std::uint8_t, kFeatureCount>;
/// The term of maximum membership of each feature; the earlier one on a tie.
Tags ChooseTags(const Grades& grades);
std::string_view TagName(const Tags& tags, Feature feature);

}  // namespace etude
