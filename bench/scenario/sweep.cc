#include "bench/scenario/sweep.h"

#include <algorithm>
#include <cmath>

#include "engine/base/names.h"

namespace etude {
namespace {

struct Steps {
  double from = 0, to = 0;
  std::size_t count = 0;
  double step = 0;  ///< 0 = the range has `count` values from `from` to `to`, both included
  bool logarithmic = false;
};

double ValueAt(const Steps& steps, std::size_t i) {
  if (steps.step != 0) return steps.from + static_cast<double>(i) * steps.step;
  if (i + 1 == steps.count) return steps.to;
  const double share = static_cast<double>(i) / static_cast<double>(steps.count - 1);
  if (steps.logarithmic) return steps.from * std::pow(steps.to / steps.from, share);
  return steps.from + share * (steps.to - steps.from);
}

/// Writes a number with 12 digits, counted from the first digit of the range's largest value. Thus 0.3 − 3 × 0.1 reads
/// 0 and not -5.55111512313e-17.
std::string Write(double value, const Steps& steps) {
  const double largest = std::max(std::abs(steps.from), std::abs(steps.to));
  const double unit = std::pow(10, std::floor(std::log10(largest)) - 11);
  const bool rounds = !steps.logarithmic && std::isnormal(unit);
  return fmt::format("{:.12g}", rounds ? std::round(value / unit) * unit + 0.0 : value);  // + 0.0 turns -0 into 0
}

Result<Steps> ReadRange(const Node::Entry& swept, std::size_t most) {
  ASSIGN_OR_RETURN(const RangeWords words, ReadMapping(swept.value, "a range", RangeFields(most)));
  // Check the keys.
  const auto& [from, to, step, count, is_logarithmic] = words;
  Steps steps{.from = from, .to = to, .logarithmic = is_logarithmic};
  const Place& place = swept.value.place;
  if (step.has_value() == count.has_value()) {
    return Fail(place, "a range needs either 'step' or 'count', found {}", step ? "both" : "neither");
  }
  if (steps.logarithmic && (step || steps.from <= 0 || steps.to <= 0)) {
    return Fail(place, "'scale: log' needs the key 'count', and values above 0 of 'from' and 'to'");
  }
  if (!std::isfinite(steps.logarithmic ? steps.to / steps.from : steps.to - steps.from)) {
    return Fail(place, "the values {} and {} of a range are too far apart", steps.from, steps.to);
  }
  // Take the given number of values, or compute the number from the step.
  if (count) {
    steps.count = *count;
    return steps;
  }
  steps.step = *step;
  const double whole_steps = std::floor((steps.to - steps.from) / steps.step + 1e-9);
  if (steps.step == 0 || whole_steps < 0) {
    return Fail(place, "a 'step' of {} cannot lead from {} to {}", steps.step, steps.from, steps.to);
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
  return {
      {Key::Number("from", &RangeWords::from, {}, "The first value.").WhenAbsent(""),
       Key::Number("to", &RangeWords::to, {}, "The last value. With `step`, the range ends at or before this value.")
           .WhenAbsent(""),
       Key::Number("step", &RangeWords::step, {}, "Difference between successive values.")
           .And("not 0")
           .WhenAbsent("(from `count`)"),
       Key::Number("count", &RangeWords::count, {2, static_cast<double>(most)}, "Number of values from `from` to `to`.")
           .WhenAbsent("(from `step`)"),
       Key::Name("scale", &RangeWords::is_logarithmic, {{"linear", false}, {"log", true}},
                 "linear: successive values have equal differences; log: successive values have equal ratios. `log` "
                 "needs `count`.")}};
}

Result<std::vector<Node>> SweptValues(const Node::Entry& swept, std::size_t most) {
  const Node& value = swept.value;
  // The values are given as a range.
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
  // The values are given as a list.
  if (value.kind != Node::Kind::kSequence || value.items.empty()) {
    return Fail(
        value.place,
        "the swept parameter '{}' needs a list of values or a range such as {{from: 5, to: 20, step: 5}}, found {}",
        swept.key, Describe(value));
  }
  if (value.items.size() > most) return Fail(value.place, "'{}' has more than {} values", swept.key, most);
  for (const Node& item : value.items) {
    if (item.kind != Node::Kind::kScalar) {
      return Fail(item.place, "a swept value must be a number or a text, found {}", Describe(item));
    }
    if (item.scalar.empty() || item.scalar.find_first_of(",=/ ") != std::string::npos) {
      return Fail(item.place, "a swept value must not contain ',', '=', '/' or a space, found {}", Describe(item));
    }
  }
  return value.items;
}

namespace {

/// One point of an axis: the parameters that it sets, with their values.
using Point = std::vector<Node::Entry>;
using Axis = std::vector<Point>;

constexpr const char* kTogether = "together";

/// Returns true if two values are equal. "1" and "1.0" are equal, because they are the same number.
bool SameValue(const Node& a, const Node& b) {
  if (a.scalar == b.scalar) return true;
  const auto x = AsNumber(a), y = AsNumber(b);
  return x && y && *x == *y;
}

bool SamePoint(const Point& a, const Point& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Node::Entry& x, const Node::Entry& y) { return SameValue(x.value, y.value); });
}

/// Returns a copy of the condition with the values of `point`.
Condition At(Condition condition, const Point& point) {
  for (const Node::Entry& entry : point) {
    condition.swept.push_back({entry.key, entry.value.scalar});
    std::erase_if(condition.node.entries, [&](const Node::Entry& other) { return other.key == entry.key; });
    condition.node.entries.push_back(entry);
  }
  return condition;
}

/// Reads the axis of parameters that change their values together: the k-th point has the k-th value of each parameter.
Result<Axis> ReadAxis(const std::vector<Node::Entry>& parameters) {
  Axis axis;
  for (const Node::Entry& parameter : parameters) {
    ASSIGN_OR_RETURN(const auto values, SweptValues(parameter, kMaxConditions));
    if (axis.empty()) axis.resize(values.size());
    if (axis.size() != values.size()) {
      return Fail(parameter.value.place,
                  "'{}' and '{}' change together, so they need equal numbers of values, found {} and {}",
                  parameters.front().key, parameter.key, axis.size(), values.size());
    }
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i].push_back({parameter.key, parameter.place, values[i]});
  }
  // Fail if two points are equal.
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const auto repeated = [&](const Point& other) { return SamePoint(axis[i], other); };
    const auto here = axis.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::none_of(axis.begin(), here, repeated)) continue;
    const Point& point = axis[i];
    if (point.size() == 1) {
      return Fail(point[0].value.place, "the value '{}' is listed twice", point[0].value.scalar);
    }
    return Fail(point[0].value.place, "the values '{}' are listed twice", ConditionLabel(At({}, point).swept));
  }
  return axis;
}

/// Reads the groups of `together`, which is one mapping or a list of mappings.
Result<std::vector<Node>> ReadGroups(const Node& together) {
  const bool is_list = together.kind == Node::Kind::kSequence && !together.items.empty();
  const std::vector<Node> groups = is_list ? together.items : std::vector{together};
  for (const Node& group : groups) {
    if (group.kind == Node::Kind::kMapping && group.entries.size() >= 2) continue;
    return Fail(group.place,
                "'together' needs at least two parameters with equal numbers of values, such as {{noise: [1, 2], "
                "turn_deg: [0, 60]}}, found {}",
                group.kind == Node::Kind::kMapping ? "fewer" : Describe(group));
  }
  return groups;
}

/// Fails if a parameter is not one of the task's parameters, because only these can be swept.
Result<void> CheckParameter(const Node::Entry& parameter, const TaskKind& kind, bool in_group) {
  for (const KeyInfo& common : CommonScenarioKeys()) {
    if (common.key != parameter.key) continue;
    return Fail(parameter.place, "'{}' cannot be swept; allowed: only parameters of the task", parameter.key);
  }
  std::vector<std::string> known;
  for (const KeyInfo& key : kind.condition_keys) known.push_back(key.key);
  if (!in_group) known.push_back(kTogether);
  if (std::find(known.begin(), known.end(), parameter.key) != known.end()) return {};
  return Fail(parameter.place, "{}", UnknownName("parameter of task " + kind.name, parameter.key, known));
}

Result<std::vector<Axis>> ReadAxes(const Node& sweep, const TaskKind& kind) {
  if (sweep.kind != Node::Kind::kMapping) {
    return Fail(sweep.place, "'sweep' must be a mapping from parameters to lists or ranges of values, found {}",
                Describe(sweep));
  }
  std::vector<Axis> axes;
  std::vector<std::string> seen;
  // Adds the axis that `parameters` form. Each parameter may be swept once.
  const auto add = [&](const std::vector<Node::Entry>& parameters, bool in_group) -> Result<void> {
    for (const Node::Entry& parameter : parameters) {
      RETURN_IF_ERROR(CheckParameter(parameter, kind, in_group));
      if (std::find(seen.begin(), seen.end(), parameter.key) != seen.end()) {
        return Fail(parameter.place, "'{}' is swept twice", parameter.key);
      }
      seen.push_back(parameter.key);
    }
    ASSIGN_OR_RETURN(auto axis, ReadAxis(parameters));
    axes.push_back(std::move(axis));
    return {};
  };
  // A single parameter is an axis of its own, and so is each group of `together`.
  for (const Node::Entry& swept : sweep.entries) {
    if (swept.key != kTogether) {
      RETURN_IF_ERROR(add({swept}, false));
      continue;
    }
    ASSIGN_OR_RETURN(const auto groups, ReadGroups(swept.value));
    for (const Node& group : groups) {
      RETURN_IF_ERROR(add(group.entries, true));
    }
  }
  return axes;
}

}  // namespace

std::vector<Condition> ReadSweep(Fields& fields, const TaskKind& kind) {
  std::vector<Condition> conditions = {Condition{{}, fields.node()}};
  const Node* sweep = fields.Raw("sweep");
  if (sweep == nullptr) return conditions;
  const auto axes = ReadAxes(*sweep, kind);
  if (!axes) {
    fields.Complain(axes.error().place, axes.error().message);
    return conditions;
  }
  // Check the size of the product of the axes before it is built.
  const std::size_t values = CountValues(fields.node());
  for (const Axis& axis : *axes) {
    const std::size_t count = conditions.size() * axis.size();
    if (count > kMaxConditions || count * values > kMaxFileValues) {
      fields.Complain(
          sweep->place,
          count > kMaxConditions
              ? fmt::format("the sweep has more than {} conditions", kMaxConditions)
              : fmt::format(
                    "found {} conditions, each with {} values; allowed: at most {} values in all conditions together",
                    count, values, kMaxFileValues));
      return conditions;
    }
    // Combine every condition so far with every point of this axis.
    std::vector<Condition> product;
    for (const Condition& condition : conditions) {
      for (const Point& point : axis) product.push_back(At(condition, point));
    }
    conditions = std::move(product);
  }
  return conditions;
}

}  // namespace etude
