#include "bench/scenario/sweep.h"

#include <algorithm>

#include "bench/scenario/ranges.h"
#include "engine/base/names.h"

namespace etude {
namespace {

/// A point of an axis: the keys that are set there.
using Point = std::vector<Node::Entry>;
using Axis = std::vector<Point>;

constexpr const char* kTogether = "together";

/// "1" and "1.0" are the same number, though they read differently.
bool SameValue(const Node& a, const Node& b) {
  if (a.scalar == b.scalar) return true;
  const auto x = AsNumber(a), y = AsNumber(b);
  return x && y && *x == *y;
}

bool SamePoint(const Point& a, const Point& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Node::Entry& x, const Node::Entry& y) { return SameValue(x.value, y.value); });
}

/// The condition with the keys of `point` set.
Condition At(Condition condition, const Point& point) {
  for (const Node::Entry& entry : point) {
    condition.swept.push_back({entry.key, entry.value.scalar});
    std::erase_if(condition.node.entries, [&](const Node::Entry& other) { return other.key == entry.key; });
    condition.node.entries.push_back(entry);
  }
  return condition;
}

/// Parameters stepped through together: the first point has the first value of each.
Result<Axis> ReadAxis(const std::vector<Node::Entry>& parameters) {
  Axis axis;
  for (const Node::Entry& parameter : parameters) {
    ASSIGN_OR_RETURN(const auto values, SweptValues(parameter, kMostConditions));
    if (axis.empty()) axis.resize(values.size());
    if (axis.size() != values.size()) {
      return Fail(parameter.value.place,
                  "'{}' and '{}' are stepped together; they need as many values each, found {} and {}",
                  parameters.front().key, parameter.key, axis.size(), values.size());
    }
    for (std::size_t i = 0; i < axis.size(); ++i) axis[i].push_back({parameter.key, parameter.place, values[i]});
  }
  for (std::size_t i = 0; i < axis.size(); ++i) {
    const auto repeated = [&](const Point& other) { return SamePoint(axis[i], other); };
    const auto here = axis.begin() + static_cast<std::ptrdiff_t>(i);
    if (std::none_of(axis.begin(), here, repeated)) continue;
    const Point& point = axis[i];
    if (point.size() == 1) {
      return Fail(point[0].value.place, "the value '{}' stands here twice", point[0].value.scalar);
    }
    return Fail(point[0].value.place, "the values '{}' stand here twice", ConditionLabel(At({}, point).swept));
  }
  return axis;
}

/// The groups of `together`: one mapping, or a list of them.
Result<std::vector<Node>> ReadGroups(const Node& together) {
  const bool is_list = together.kind == Node::Kind::kSequence && !together.items.empty();
  const std::vector<Node> groups = is_list ? together.items : std::vector{together};
  for (const Node& group : groups) {
    if (group.kind == Node::Kind::kMapping && group.entries.size() >= 2) continue;
    return Fail(group.place,
                "'together' needs at least two parameters with as many values each, such as "
                "{{noise: [1, 2], turn_deg: [0, 60]}}, found {}",
                group.kind == Node::Kind::kMapping ? "fewer" : Describe(group));
  }
  return groups;
}

/// Only a task's own parameters can be swept.
Result<void> CheckParameter(const Node::Entry& parameter, const TaskKind& kind, bool in_group) {
  for (const KeyInfo& common : CommonScenarioKeys()) {
    if (common.key != parameter.key) continue;
    return Fail(parameter.place, "'{}' cannot be swept; only a task's parameters can", parameter.key);
  }
  std::vector<std::string> known;
  for (const KeyInfo& key : kind.condition_keys) known.push_back(key.key);
  if (!in_group) known.push_back(kTogether);
  if (std::find(known.begin(), known.end(), parameter.key) != known.end()) return {};
  return Fail(parameter.place, "{}", UnknownName("parameter of task " + kind.name, parameter.key, known));
}

Result<std::vector<Axis>> ReadAxes(const Node& sweep, const TaskKind& kind) {
  if (sweep.kind != Node::Kind::kMapping) {
    return Fail(sweep.place, "'sweep' must map parameters to lists or ranges of values, found {}", Describe(sweep));
  }
  std::vector<Axis> axes;
  std::vector<std::string> seen;
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
  const std::size_t values = CountValues(fields.node());
  for (const Axis& axis : *axes) {
    const std::size_t count = conditions.size() * axis.size();
    if (count > kMostConditions || count * values > kMostValues) {
      fields.Complain(sweep->place,
                      count > kMostConditions
                          ? fmt::format("the sweep has more than {} conditions", kMostConditions)
                          : fmt::format("{} conditions of a scenario of {} values; at most {} values in all", count,
                                        values, kMostValues));
      return conditions;
    }
    std::vector<Condition> product;
    for (const Condition& condition : conditions) {
      for (const Point& point : axis) product.push_back(At(condition, point));
    }
    conditions = std::move(product);
  }
  return conditions;
}

}  // namespace etude
