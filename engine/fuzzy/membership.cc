#include "engine/fuzzy/membership.h"

#include <algorithm>

namespace etude {
namespace {

using enum Feature;

constexpr std::array<Term, kTermCount> kTerms = {{
    {kRH, "down"},       {kRH, "mid"},       {kRH, "up"},       {kLH, "down"},    {kLH, "mid"},      {kLH, "up"},
    {kRHE, "false"},     {kRHE, "true"},     {kLHE, "false"},   {kLHE, "true"},   {kPosture, "lie"}, {kPosture, "sit"},
    {kPosture, "stand"}, {kPosture, "jump"}, {kTrunk, "false"}, {kTrunk, "true"}, {kRF, "inward"},   {kRF, "outward"},
    {kLF, "inward"},     {kLF, "outward"},   {kRFK, "false"},   {kRFK, "true"},   {kLFK, "false"},   {kLFK, "true"},
}};

/// kFirstTerm[k] … kFirstTerm[k + 1] are the terms of feature k.
constexpr std::array<std::size_t, kFeatureCount + 1> kFirstTerm = [] {
  std::array<std::size_t, kFeatureCount + 1> first{};
  for (const Term& term : kTerms) ++first[static_cast<std::size_t>(term.feature) + 1];
  for (std::size_t k = 0; k < kFeatureCount; ++k) first[k + 1] += first[k];
  return first;
}();

}  // namespace

std::span<const Term, kTermCount> AllTerms() { return kTerms; }

std::size_t FirstTermOf(Feature feature) { return kFirstTerm[static_cast<std::size_t>(feature)]; }

std::span<const Term> TermsOf(Feature feature) {
  const std::size_t k = static_cast<std::size_t>(feature);
  return std::span(kTerms).subspan(kFirstTerm[k], kFirstTerm[k + 1] - kFirstTerm[k]);
}

Grades Fuzzify(const PoseFeatures& features, const Memberships& memberships) {
  Grades grades{};
  for (std::size_t i = 0; i < kTermCount; ++i) {
    const std::size_t k = static_cast<std::size_t>(kTerms[i].feature);
    const Universe& universe = memberships.universes[k];
    grades[i] = GradeOf(memberships.shapes[i], std::clamp(features.values[k], universe.low, universe.high));
  }
  return grades;
}

Tags ChooseTags(const Grades& grades) {
  Tags tags{};
  for (std::size_t k = 0; k < kFeatureCount; ++k) {
    const auto first = grades.begin() + kFirstTerm[k];
    const auto last = grades.begin() + kFirstTerm[k + 1];
    tags[k] = static_cast<std::uint8_t>(std::max_element(first, last) - first);
  }
  return tags;
}

std::string_view TagName(const Tags& tags, Feature feature) {
  return TermsOf(feature)[tags[static_cast<std::size_t>(feature)]].name;
}

}  // namespace etude
