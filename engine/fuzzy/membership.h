#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "engine/fuzzy/features.h"
#include "engine/fuzzy/shape.h"

namespace etude {

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

/// Equations 2–16, as scenarios/fuzzy/paper.yaml holds them. Elbow, trunk and knee grades do not sum to 1: so printed,
/// so kept.
const Memberships& PaperMemberships();

/// How far a pose belongs to each of the 24 terms, in the order of `AllTerms`.
using Grades = std::array<double, kTermCount>;
Grades Fuzzify(const PoseFeatures& features, const Memberships& memberships = PaperMemberships());

/// One term per feature, as its place in `TermsOf`.
using Tags = std::array<std::uint8_t, kFeatureCount>;
/// The term of maximum membership of each feature; the earlier one on a tie.
Tags ChooseTags(const Grades& grades);
std::string_view TagName(const Tags& tags, Feature feature);

}  // namespace etude
