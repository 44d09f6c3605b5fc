#include "bench/scenario/ranges.h"

#include <algorithm>
#include <cmath>

#include "engine/document/fields.h"

namespace etude {
namespace {

struct Steps {
  double from = 0, to = 0;
  std::size_t count = 0;
  double step = 0;  ///< 0: spread evenly from `from` to `to`, both included
  bool logarithmic = false;
};

double ValueAt(const Steps& steps, std::size_t i) {
  if (steps.step != 0) return steps.from + static_cast<double>(i) * steps.step;
  if (i + 1 == steps.count) return steps.to;
  const double share = static_cast<double>(i) / static_cast<double>(steps.count - 1);
  if (steps.logarithmic) return steps.from * std::pow(steps.to / steps.from, share);
  return steps.from + share * (steps.to - steps.from);
}

/// With 12 digits of a range's largest value, lest 0.3 − 3 × 0.1 reads -5.55111512313e-17.
std::string Write(double value, const Steps& steps) {
  const double largest = std::max(std::abs(steps.from), std::abs(steps.to));
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 11);
  const bool rounds = !steps.logarithmic && std::isnormal(unit);
  return fmt::format("{:.12g}", rounds ? std::round(value / unit) * unit + 0.0 : value);  // + 0.0: never -0
}

Result<Steps> ReadRange(const Node::Entry& swept, std::size_t most) {
  ASSIGN_OR_RETURN(const RangeWords words, ReadMapping(swept.value, "a range", RangeFields(most)));
  const auto& [from, to, step, count, is_logarithmic] = words;
  Steps steps{.from = from, .to = to, .logarithmic = is_logarithmic};
  const Place& place = swept.value.place;
  if (step.has_value() == count.has_value()) {
    return Fail(place, "a range says either 'step' or 'count', found {}", step ? "both" : "neither");
  }
  if (steps.logarithmic && (step || steps.from <= 0 || steps.to <= 0)) {
    return Fail(place, "'scale: log' needs 'count', and 'from' and 'to' above 0");
  }
  if (!std::isfinite(steps.logarithmic ? steps.to / steps.from : steps.to - steps.from)) {
    return Fail(place, "{} and {} are too far apart", steps.from, steps.to);
  }
  if (count) {
    steps.count = *count;
    return steps;
  }
  steps.step = *step;
  const double whole_steps = std::floor((steps.to - steps.from) / steps.step + 1e-9);
  if (steps.step == 0 || whole_steps < 0) {
    return Fail(place, "steps of {} do not lead from {} to {}", steps.step, steps.from, steps.to);
  }
  if (!(whole_steps < static_cast<double>(most))) {
    return Fail(place, "the range has more than {} values", most);
  }
  steps.count = static_cast<std::size_t>(whole_steps) + 1;
  return steps;
}

}  // namespace

FieldTable<RangeWords> RangeFields(std::size_t most) {
  using Key = Field<RangeWords>;
  return {{Key::Number("from", &RangeWords::from, {}, "The first value.").WhenAbsent(""),
           Key::Number("to", &RangeWords::to, {}, "The last value; with `step`, it is not passed.").WhenAbsent(""),
           Key::Number("step", &RangeWords::step, {}, "From one value to the next.")
               .And("not 0")
               .WhenAbsent("(`count` says it)"),
           Key::Number("count", &RangeWords::count, {2, static_cast<double>(most)},
                       "How many values, spread from `from` to `to`.")
               .WhenAbsent("(`step` says it)"),
           Key::Name("scale", &RangeWords::is_logarithmic, {{"linear", false}, {"log", true}},
                     "Equal differences, or equal ratios; log goes with `count`.")}};
}

Result<std::vector<Node>> SweptValues(const Node::Entry& swept, std::size_t most) {
  const Node& value = swept.value;
  if (value.kind == Node::Kind::kMapping) {
    ASSIGN_OR_RETURN(const auto steps, ReadRange(swept, most));
    std::vector<Node> values;
    for (std::size_t i = 0; i < steps.count; ++i) {
      Node node;
      node.kind = Node::Kind::kScalar;
      node.scalar = Write(ValueAt(steps, i), steps);
      node.place = value.place;
      values.push_back(std::move(node));
    }
    return values;
  }
  if (value.kind != Node::Kind::kSequence || value.items.empty()) {
    return Fail(value.place,
                "'{}' needs a list of values to sweep over, or a range such as {{from: 5, to: 20, step: 5}}, "
                "found {}",
                swept.key, Describe(value));
  }
  if (value.items.size() > most) return Fail(value.place, "'{}' has more than {} values", swept.key, most);
  for (const Node& item : value.items) {
    if (item.kind != Node::Kind::kScalar) {
      return Fail(item.place, "a swept value must be a number or a text, found {}", Describe(item));
    }
    if (item.scalar.empty() || item.scalar.find_first_of(",=/ ") != std::string::npos) {
      return Fail(item.place, "a swept value has no ',', '=', '/' or space, found {}", Describe(item));
    }
  }
  return value.items;
}

}  // namespace etude
