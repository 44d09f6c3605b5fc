#include "tests/reports/support/effector_run.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/reports/support/example_run.h"

namespace etude {
namespace {

constexpr int kDofs = 29;
constexpr std::array<const char*, 4> kEffectors{"right_foot", "left_hand", "right_hand", "head"};
constexpr std::array<const char*, 3> kAxes{"x", "y", "z"};

double Sign(int trial) { return trial % 2 == 0 ? 1 : -1; }

void AddErrors(int method, int trial, std::vector<Series>& series) {
  for (int axis = 0; axis < 3; ++axis) {
    Series start_position{fmt::format("start_position_error_{}_cm", kAxes[axis]), "effector", {}};
    Series position{fmt::format("position_error_{}_cm", kAxes[axis]), "effector", {}};
    Series start_axis{fmt::format("start_orientation_error_{}_deg", kAxes[axis]), "effector", {}};
    Series orientation{fmt::format("orientation_error_{}_deg", kAxes[axis]), "effector", {}};
    for (int e = 0; e < 4; ++e) {
      start_position.values.push_back(StartPositionError(trial, e, axis));
      position.values.push_back(PositionError(method, trial, e, axis));
      start_axis.values.push_back(40 + e + 0.1 * axis);
      orientation.values.push_back(OrientationError(method, trial, e, axis));
    }
    for (Series* added : {&start_position, &position, &start_axis, &orientation}) series.push_back(std::move(*added));
  }
}

void AddAngles(int method, int trial, std::vector<Series>& series) {
  Series change{"angle_change_deg", "angle", {}}, error{"angle_error_deg", "angle", {}};
  for (int dof = 0; dof < kDofs; ++dof) {
    change.values.push_back(AngleChange(method, trial, dof));
    error.values.push_back(-0.5 * AngleChange(method, trial, dof));
  }
  series.push_back(std::move(change));
  series.push_back(std::move(error));
}

void AddCurves(int method, int trial, std::vector<Series>& series) {
  const int length = 150 - 25 * method + trial;
  for (std::size_t e = 0; e < kEffectors.size(); ++e) {
    for (const char* name : {"position_error_cm", "x_axis_error_deg", "y_axis_error_deg", "z_axis_error_deg"}) {
      Series curve{fmt::format("{}_{}", kEffectors[e], name), "iteration", {}};
      for (int i = 0; i < length; ++i) {
        curve.values.push_back((60 - 8.0 * static_cast<double>(e)) * std::exp(-0.04 * (1 + method) * i) + 1e-4);
      }
      series.push_back(std::move(curve));
    }
  }
}

}  // namespace

double StartPositionError(int trial, int effector, int axis) {
  return Sign(trial) * (30 + effector + 0.1 * axis + 0.001 * trial);
}

double PositionError(int method, int trial, int effector, int axis) {
  return Sign(trial) * (method + 0.1 * effector + 0.01 * axis + 0.0001 * trial);
}

double OrientationError(int method, int trial, int effector, int axis) {
  return 5 + method + 0.1 * effector + 0.01 * axis + 0.0001 * trial;
}

double AngleChange(int method, int trial, int dof) { return Sign(trial) * (dof + 0.1 * method + 0.001 * trial); }

RunData EffectorRun() {
  RunData run = ExampleRun();
  const ScenarioSummary& scenario = run.scenarios[2];
  for (CellSeries& cell : run.series) {
    for (const Row& row : run.rows) {
      if (row.Id() != cell.cell || row.scenario != scenario.name) continue;
      const auto method = static_cast<int>(std::ranges::find(scenario.methods, row.method) - scenario.methods.begin());
      AddErrors(method, row.trial, cell.series);
      AddAngles(method, row.trial, cell.series);
      AddCurves(method, row.trial, cell.series);
    }
  }
  return run;
}

}  // namespace etude
