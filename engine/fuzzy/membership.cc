#include "engine/fuzzy/membership.h"

#include <algorithm>
#include <cmath>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/document/fields.h"

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
    // The limits are computed from the top, so that grade 1 gives exactly the top.
    return {left_top - (1 - grade) * (left_top - left), right_top + (1 - grade) * (right - right_top)};
  }
};

using enum Feature;

constexpr std::array<Term, kTermCount> kTerms = {{
    {kRH, "down"},       {kRH, "mid"},       {kRH, "up"},       {kLH, "down"},    {kLH, "mid"},      {kLH, "up"},
    {kRHE, "false"},     {kRHE, "true"},     {kLHE, "false"},   {kLHE, "true"},   {kPosture, "lie"}, {kPosture, "sit"},
    {kPosture, "stand"}, {kPosture, "jump"}, {kTrunk, "false"}, {kTrunk, "true"}, {kRF, "inward"},   {kRF, "outward"},
    {kLF, "inward"},     {kLF, "outward"},   {kRFK, "false"},   {kRFK, "true"},   {kLFK, "false"},   {kLFK, "true"},
}};

/// The terms of feature k have the indices kFirstTerm[k] … kFirstTerm[k + 1] − 1 in `AllTerms`.
constexpr std::array<std::size_t, kFeatureCount + 1> kFirstTerm = [] {
  std::array<std::size_t, kFeatureCount + 1> first{};
  for (const Term& term : kTerms) ++first[static_cast<std::size_t>(term.feature) + 1];
  for (std::size_t k = 0; k < kFeatureCount; ++k) first[k + 1] += first[k];
  return first;
}();

/// A kind of shape, with its name in files and the numbers that define it.
struct ShapeKind {
  const char* name;
  const char* numbers;
  std::size_t count;
  Shape (*make)(const std::vector<double>& v);
};

constexpr ShapeKind kKinds[] = {
    {"triangular", "[left, peak, right]", 3,
     [](const auto& v) -> Shape {
       return Triangular{v[0], v[1], v[2]};
     }},
    {"trapezoidal", "[left, left top, right top, right]", 4,
     [](const auto& v) -> Shape {
       return Trapezoidal{v[0], v[1], v[2], v[3]};
     }},
    {"gaussian", "[mean, sigma]", 2,
     [](const auto& v) -> Shape {
       return Gaussian{v[0], v[1]};
     }},
    {"singleton", "a number", 1, [](const auto& v) -> Shape { return Singleton{v[0]}; }},
};

constexpr double kMaxNumber = 1e6;  // far above any angle or height; with this limit, all sums stay finite
constexpr double kMinSigma = 1e-3;  // a narrower shape should be a singleton

std::vector<double> NumbersOf(const Shape& shape) {
  struct Visitor {
    std::vector<double> operator()(const Triangular& s) const { return {s.left, s.peak, s.right}; }
    std::vector<double> operator()(const Trapezoidal& s) const { return {s.left, s.left_top, s.right_top, s.right}; }
    std::vector<double> operator()(const Gaussian& s) const { return {s.mean, s.sigma}; }
    std::vector<double> operator()(const Singleton& s) const { return {s.at}; }
  };
  return std::visit(Visitor{}, shape);
}

Result<std::vector<double>> ReadNumbers(const Node& node, const ShapeKind& kind) {
  const bool is_list = node.kind == Node::Kind::kSequence;
  const bool fits = kind.count == 1 ? node.kind == Node::Kind::kScalar : is_list && node.items.size() == kind.count;
  if (!fits) {
    return Fail(node.place, "'{}' needs {}, found {}", kind.name, kind.numbers,
                is_list ? fmt::format("a list of {}", node.items.size()) : Describe(node));
  }
  std::vector<double> numbers;
  for (const Node& item : is_list ? std::span(node.items) : std::span(&node, 1)) {
    ASSIGN_OR_RETURN(const auto number, AsNumber(item));
    if (std::abs(number) > kMaxNumber) return Fail(item.place, "{} is out of range; allowed: ±{}", number, kMaxNumber);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

double GradeOf(const Shape& shape, double input) { return std::visit(At{input}, shape); }

Cut CutOf(const Shape& shape, double grade) { return std::visit(CutAt{grade}, shape); }

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

Result<Shape> ReadShape(const Node& node, const Universe& universe) {
  // Read the kind and its numbers.
  const std::vector<std::string> names = NamesOf(kKinds);
  if (node.kind != Node::Kind::kMapping || node.entries.size() != 1) {
    return Fail(
        node.place, "a term needs one shape, such as {{triangular: [20, 90, 180]}}; found {}. Allowed shapes: {}",
        node.kind == Node::Kind::kMapping ? fmt::format("{} keys", node.entries.size()) : Describe(node), Join(names));
  }
  const Node::Entry& entry = node.entries.front();
  const auto kind = std::ranges::find(kKinds, entry.key, [](const ShapeKind& k) { return std::string(k.name); });
  if (kind == std::end(kKinds)) return Fail(entry.place, "{}", UnknownName("shape", entry.key, names));
  ASSIGN_OR_RETURN(const auto numbers, ReadNumbers(entry.value, *kind));
  // Check the numbers, and that the universe contains an input of grade 1.
  const Shape shape = kind->make(numbers);
  if (std::holds_alternative<Gaussian>(shape)) {
    const double sigma = numbers.back();
    if (sigma < kMinSigma) {
      return Fail(entry.value.items.back().place, "sigma must be at least {}, found {}", kMinSigma, sigma);
    }
  } else if (const auto fall = std::ranges::is_sorted_until(numbers); fall != numbers.end()) {
    return Fail(entry.value.items[static_cast<std::size_t>(fall - numbers.begin())].place,
                "'{}' needs numbers {} that do not decrease, found {} after {}", kind->name, kind->numbers, *fall,
                *(fall - 1));
  }
  const Cut top = CutOf(shape, 1);
  if (top.high < universe.low || top.low > universe.high) {
    return Fail(entry.value.place,
                "no input has grade 1, because the universe [{}, {}] does not contain the maximum of the term at {}{}",
                universe.low, universe.high, top.low, top.high > top.low ? fmt::format(" to {}", top.high) : "");
  }
  return shape;
}

std::string WriteShape(const Shape& shape) {
  const ShapeKind& kind = kKinds[shape.index()];
  std::vector<std::string> numbers;
  for (double number : NumbersOf(shape)) numbers.push_back(fmt::format("{}", number));
  const std::string listed = Join(numbers);
  return fmt::format("{{{}: {}}}", kind.name, kind.count == 1 ? listed : fmt::format("[{}]", listed));
}

}  // namespace etude
