#include "engine/fuzzy/membership.h"

#include <algorithm>

namespace etude {
namespace {

using enum Feature;

// Arm raise: equations 2, 3, 4.
constexpr std::array<Breakpoint, 2> kArmDown = {{{20, 1}, {90, 0}}};
constexpr std::array<Breakpoint, 3> kArmMid = {{{20, 0}, {90, 1}, {180, 0}}};
constexpr std::array<Breakpoint, 2> kArmUp = {{{90, 0}, {180, 1}}};
// Elbow: equations 5, 6.
constexpr std::array<Breakpoint, 2> kElbowStraight = {{{0, 1}, {90, 0}}};
constexpr std::array<Breakpoint, 2> kElbowBent = {{{20, 0}, {90, 1}}};
// Posture: equations 7, 8, 9 (printed "sit" a second time, meant is "stand"), 10.
constexpr std::array<Breakpoint, 2> kLie = {{{0, 1}, {40, 0}}};
constexpr std::array<Breakpoint, 3> kSit = {{{0, 0}, {40, 1}, {80, 0}}};
constexpr std::array<Breakpoint, 3> kStand = {{{40, 0}, {80, 1}, {120, 0}}};
constexpr std::array<Breakpoint, 2> kJump = {{{80, 0}, {120, 1}}};
// Trunk: equations 12, 11.
constexpr std::array<Breakpoint, 2> kTrunkUpright = {{{125, 0}, {180, 1}}};
constexpr std::array<Breakpoint, 2> kTrunkBent = {{{110, 1}, {180, 0}}};
// Leg spread: equations 13, 14.
constexpr std::array<Breakpoint, 2> kInward = {{{0, 1}, {40, 0}}};
constexpr std::array<Breakpoint, 2> kOutward = {{{0, 0}, {40, 1}}};
// Knee: equations 16, 15.
constexpr std::array<Breakpoint, 2> kKneeStraight = {{{100, 0}, {180, 1}}};
constexpr std::array<Breakpoint, 2> kKneeBent = {{{90, 1}, {180, 0}}};

constexpr std::array<Term, kTermCount> kTerms = {{
    {kRH, "down", kArmDown},         {kRH, "mid", kArmMid},          {kRH, "up", kArmUp},
    {kLH, "down", kArmDown},         {kLH, "mid", kArmMid},          {kLH, "up", kArmUp},
    {kRHE, "false", kElbowStraight}, {kRHE, "true", kElbowBent},     {kLHE, "false", kElbowStraight},
    {kLHE, "true", kElbowBent},      {kPosture, "lie", kLie},        {kPosture, "sit", kSit},
    {kPosture, "stand", kStand},     {kPosture, "jump", kJump},      {kTrunk, "false", kTrunkUpright},
    {kTrunk, "true", kTrunkBent},    {kRF, "inward", kInward},       {kRF, "outward", kOutward},
    {kLF, "inward", kInward},        {kLF, "outward", kOutward},     {kRFK, "false", kKneeStraight},
    {kRFK, "true", kKneeBent},       {kLFK, "false", kKneeStraight}, {kLFK, "true", kKneeBent},
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

double MembershipGrade(std::span<const Breakpoint> shape, double input) {
  if (input <= shape.front().input) return shape.front().grade;
  for (std::size_t i = 1; i < shape.size(); ++i) {
    if (input > shape[i].input) continue;
    const Breakpoint& low = shape[i - 1];
    const Breakpoint& high = shape[i];
    return low.grade + (high.grade - low.grade) * (input - low.input) / (high.input - low.input);
  }
  return shape.back().grade;
}

Grades Fuzzify(const PoseFeatures& features) {
  Grades grades{};
  for (std::size_t i = 0; i < kTermCount; ++i) {
    grades[i] = MembershipGrade(kTerms[i].shape, features[kTerms[i].feature]);
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
