#include "engine/fuzzy/membership.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

double Rise(double from, double to, double x) { return x >= to ? 1.0 : x <= from ? 0.0 : (x - from) / (to - from); }
double Fall(double from, double to, double x) { return x <= from ? 1.0 : x >= to ? 0.0 : (to - x) / (to - from); }

struct At {
  double x;
  double operator()(const Triangular& s) const {
    return x <= s.peak ? Rise(s.left, s.peak, x) : Fall(s.peak, s.right, x);
  }
  double operator()(const Trapezoidal& s) const {
    return x < s.left_top ? Rise(s.left, s.left_top, x) : Fall(s.right_top, s.right, x);
  }
  double operator()(const Gaussian& s) const {
    const double z = (x - s.mean) / s.sigma;
    return std::exp(-0.5 * z * z);
  }
  double operator()(const Singleton& s) const { return x == s.at ? 1.0 : 0.0; }
};

struct CutAt {
  double grade;
  Cut operator()(const Triangular& s) const { return Sides(s.left, s.peak, s.peak, s.right); }
  Cut operator()(const Trapezoidal& s) const { return Sides(s.left, s.left_top, s.right_top, s.right); }
  Cut operator()(const Gaussian& s) const {
    const double reach = s.sigma * std::sqrt(-2 * std::log(grade));
    return {s.mean - reach, s.mean + reach};
  }
  Cut operator()(const Singleton& s) const { return {s.at, s.at}; }
  Cut Sides(double left, double left_top, double right_top, double right) const {
    // From the top, so that grade 1 gives the top itself.
    return {left_top - (1 - grade) * (left_top - left), right_top + (1 - grade) * (right - right_top)};
  }
};

}  // namespace

double GradeOf(const Shape& shape, double input) { return std::visit(At{input}, shape); }

Cut CutOf(const Shape& shape, double grade) { return std::visit(CutAt{grade}, shape); }

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
