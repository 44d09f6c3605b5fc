#include "engine/fuzzy/shape_text.h"

#include <algorithm>

#include "engine/base/names.h"
#include "engine/document/fields.h"

namespace etude {
namespace {

/// A kind of shape: its name in files, and the numbers that make it.
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

constexpr double kLargest = 1e6;         // far beyond any angle or height; keeps every sum finite
constexpr double kSmallestSigma = 1e-3;  // narrower is a singleton

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
    if (std::abs(number) > kLargest) return Fail(item.place, "{} is out of range; allowed: ±{}", number, kLargest);
    numbers.push_back(number);
  }
  return numbers;
}

}  // namespace

Result<Shape> ReadShape(const Node& node, const Universe& universe) {
  std::vector<std::string> names;
  for (const ShapeKind& kind : kKinds) names.emplace_back(kind.name);
  if (node.kind != Node::Kind::kMapping || node.entries.size() != 1) {
    return Fail(node.place, "a term needs one shape, such as {{triangular: [20, 90, 180]}}; found {}. Allowed: {}",
                node.kind == Node::Kind::kMapping ? fmt::format("{} keys", node.entries.size()) : Describe(node),
                Join(names));
  }
  const Node::Entry& entry = node.entries.front();
  const auto kind = std::ranges::find(kKinds, entry.key, [](const ShapeKind& k) { return std::string(k.name); });
  if (kind == std::end(kKinds)) return Fail(entry.place, "{}", UnknownName("shape", entry.key, names));
  ASSIGN_OR_RETURN(const auto numbers, ReadNumbers(entry.value, *kind));
  const Shape shape = kind->make(numbers);
  if (std::holds_alternative<Gaussian>(shape)) {
    const double sigma = numbers.back();
    if (sigma < kSmallestSigma) {
      return Fail(entry.value.items.back().place, "sigma must be at least {}, found {}", kSmallestSigma, sigma);
    }
  } else if (const auto fall = std::ranges::is_sorted_until(numbers); fall != numbers.end()) {
    return Fail(entry.value.items[static_cast<std::size_t>(fall - numbers.begin())].place,
                "'{}' needs rising numbers {}, found {} after {}", kind->name, kind->numbers, *fall, *(fall - 1));
  }
  const Cut top = CutOf(shape, 1);
  if (top.high < universe.low || top.low > universe.high) {
    return Fail(entry.value.place, "no input of the universe [{}, {}] has grade 1 here: the top is at {}{}",
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
