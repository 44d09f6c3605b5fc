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

Memberships MakePaperMemberships() {
  // Arm raise: equations 2, 3, 4. Elbow: 5, 6. Posture: 7, 8, 9 (printed "sit" a second time, meant is "stand"), 10.
  // Trunk: 12, 11. Leg spread: 13, 14. Knee: 16, 15.
  const Shape arm[] = {Trapezoidal{0, 0, 20, 90}, Triangular{20, 90, 180}, Triangular{90, 180, 180}};
  const Shape elbow[] = {Triangular{0, 0, 90}, Trapezoidal{20, 90, 180, 180}};
  const Shape posture[] = {Triangular{0, 0, 40}, Triangular{0, 40, 80}, Triangular{40, 80, 120},
                           Triangular{80, 120, 120}};
  const Shape trunk[] = {Triangular{125, 180, 180}, Trapezoidal{0, 0, 110, 180}};
  const Shape spread[] = {Triangular{0, 0, 40}, Trapezoidal{0, 40, 180, 180}};
  const Shape knee[] = {Triangular{100, 180, 180}, Trapezoidal{0, 0, 90, 180}};
  Memberships paper;
  const auto set = [&](Feature feature, std::span<const Shape> shapes) {
    std::copy(shapes.begin(), shapes.end(), paper.shapes.begin() + FirstTermOf(feature));
  };
  for (Feature feature : {kRH, kLH}) set(feature, arm);
  for (Feature feature : {kRHE, kLHE}) set(feature, elbow);
  set(kPosture, posture);
  set(kTrunk, trunk);
  for (Feature feature : {kRF, kLF}) set(feature, spread);
  for (Feature feature : {kRFK, kLFK}) set(feature, knee);
  paper.universes[static_cast<std::size_t>(kPosture)] = {0, 120};
  return paper;
}

}  // namespace

std::span<const Term, kTermCount> AllTerms() { return kTerms; }

std::size_t FirstTermOf(Feature feature) { return kFirstTerm[static_cast<std::size_t>(feature)]; }

std::span<const Term> TermsOf(Feature feature) {
  const std::size_t k = static_cast<std::size_t>(feature);
  return std::span(kTerms).subspan(kFirstTerm[k], kFirstTerm[k + 1] - kFirstTerm[k]);
}

const Memberships& PaperMemberships() {
  static const Memberships paper = MakePaperMemberships();
  return paper;
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
