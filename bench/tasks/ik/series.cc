#include "bench/tasks/ik/series.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/base/angles.h"

namespace etude {
namespace {

constexpr std::array kAxisNames = {"x", "y", "z"};

template <class ValueOf>
Series Curve(std::string name, std::span<const IkTraceEntry> trace, const ValueOf& value_of) {
  Series curve{std::move(name), "iteration", {}};
  for (const IkTraceEntry& entry : trace.first(std::min<std::size_t>(trace.size(), kLongestCurve))) {
    curve.values.push_back(value_of(entry));
  }
  return curve;
}

/// Appends six series, named `prefix` + "position_error_x_cm", ….
void AppendErrors(const KinematicTree& tree, const IkProblem& problem, std::span<const double> angles,
                  std::string_view prefix, std::vector<Series>& series) {
  TreeState state = problem.start;
  state.angles.assign(angles.begin(), angles.end());
  const std::vector<LimbFrame> effectors = ComputeFrames(tree, state).effectors;
  for (int axis = 0; axis < 3; ++axis) {
    Series position{fmt::format("{}position_error_{}_cm", prefix, kAxisNames[axis]), "effector", {}};
    for (std::size_t e = 0; e < effectors.size(); ++e) {
      position.values.push_back(100 * (effectors[e].position[axis] - problem.targets[e].position[axis]));
    }
    series.push_back(std::move(position));
  }
  for (int axis = 0; axis < 3; ++axis) {
    Series orientation{fmt::format("{}orientation_error_{}_deg", prefix, kAxisNames[axis]), "effector", {}};
    for (std::size_t e = 0; e < effectors.size(); ++e) {
      orientation.values.push_back(Degrees(ErrorOf(effectors[e], problem.targets[e]).axis_angles[axis]));
    }
    series.push_back(std::move(orientation));
  }
}

Series Differences(std::string name, std::span<const double> angles, std::span<const double> others) {
  Series differences{std::move(name), "angle", {}};
  for (std::size_t i = 0; i < angles.size(); ++i) differences.values.push_back(Degrees(angles[i] - others[i]));
  return differences;
}

}  // namespace

std::vector<Series> WorstErrorCurves(std::span<const IkTraceEntry> trace) {
  return {Curve("position_error_max_cm", trace, [](const IkTraceEntry& entry) { return 100 * entry.worst_position; }),
          Curve("orientation_error_max_deg", trace,
                [](const IkTraceEntry& entry) { return Degrees(entry.worst_mean_axis); })};
}

std::vector<Series> EffectorCurves(const KinematicTree& tree, std::span<const IkTraceEntry> trace) {
  std::vector<Series> curves;
  for (std::size_t e = 0; e < tree.effectors.size(); ++e) {
    curves.push_back(Curve(fmt::format("{}_position_error_cm", tree.effectors[e].name), trace,
                           [&](const IkTraceEntry& entry) { return 100 * entry.errors[e].position; }));
    for (int axis = 0; axis < 3; ++axis) {
      curves.push_back(Curve(fmt::format("{}_{}_axis_error_deg", tree.effectors[e].name, kAxisNames[axis]), trace,
                             [&](const IkTraceEntry& entry) { return Degrees(entry.errors[e].axis_angles[axis]); }));
    }
  }
  return curves;
}

std::vector<Series> EffectorErrors(const KinematicTree& tree, const IkProblem& problem,
                                   std::span<const double> angles) {
  std::vector<Series> series;
  AppendErrors(tree, problem, problem.start.angles, "start_", series);
  AppendErrors(tree, problem, angles, "", series);
  return series;
}

std::vector<Series> AngleChanges(const IkWorld& world, std::span<const double> angles) {
  return {Differences("angle_change_deg", angles, world.problem.start.angles),
          Differences("angle_error_deg", angles, world.truth.angles)};
}

}  // namespace etude
