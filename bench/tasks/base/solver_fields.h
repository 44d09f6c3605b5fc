#pragma once

#include <vector>

#include "bench/keys/field_table.h"
#include "engine/kinematics/solvers/ik_solver.h"

namespace etude {

/// Returns the solver for a method that does not name one: gauss-newton.
const IkSolver* DefaultIkSolver();

/// Returns the default solver options, but with `most_steps` as the largest number of steps.
IkOptions IkBudget(int most_steps);

/// Returns the names of the solvers that have the settings `weights` and `refresh`.
std::vector<std::string> WeighingSolvers();

/// Adds an error if the method names a solver by its former name. The error states the present name.
void RefuseFormerName(Fields& method);

/// Declares a method's `solver` and the settings of that solver: `weights`, `refresh` and the solver's own settings.
template <typename Method>
std::vector<Field<Method>> IkSolverFields(const IkSolver* Method::*solver, IkOptions Method::*options) {
  using Key = Field<Method>;
  std::vector<Key> rows = {
      Key::Name("solver", solver, IkSolverNames(), FindIkSolver, "The solver that computes the joint angles."),
      Key::Name("weights", Path(options, &IkOptions::weights), WeightRuleNames(), FindWeightRule,
                "The rule for the weight of an effector's position error relative to the error of the effector's axes.")
          .With("solver", WeighingSolvers()),
      Key::Name("refresh", Path(options, &IkOptions::refresh), WeightRefreshNames(), FindWeightRefresh,
                "When the solver updates weights that depend on errors.")
          .With("solver", WeighingSolvers())};
  rows.front().read = [read = rows.front().read](Fields& fields, Method& method) {
    RefuseFormerName(fields);
    read(fields, method);
  };
  for (const IkSolver& one : AllIkSolvers()) {
    for (const IkSolverSetting& setting : one.settings) {
      rows.push_back(SettingField<Method>("solver", one.name, setting.number, [=](Method& method, double value) {
        setting.set((method.*options).solver_settings, value);
      }));
    }
  }
  return rows;
}

/// Declares a method's `tolerance_deg`. `meaning` says from which pose the tolerance is measured.
template <typename Method>
Field<Method> ToleranceField(IkOptions Method::*options, std::string meaning) {
  return Field<Method>::Angle("tolerance_deg", Path(options, &IkOptions::angle_change_tolerance), {0, 360},
                              std::move(meaning))
      .WhenAbsent("(no bound)");
}

/// Declares `max_sweeps`, the limit of a solver's steps.
template <typename Options>
Field<Options> SweepsField(IkOptions Options::*options, std::string meaning) {
  return Field<Options>::Number("max_sweeps", Path(options, &IkOptions::max_iterations), {1, 100'000},
                                std::move(meaning));
}

/// Reads `stop_at`, the accuracy at which solvers stop. The default is "practical".
void ReadIkGoals(Fields& condition, IkOptions& options);
template <typename Options>
Field<Options> GoalsField(IkOptions Options::*options) {
  return {{"stop_at", NameKind(std::vector<std::string>{"practical", "tight"}), "practical",
           "The accuracy at which solvers stop, for the position and each axis of every effector. practical: 0.1 cm "
           "and 0.1°; tight: 10⁻³ cm and 10⁻³°."},
          [=](Fields& condition, Options& o) { ReadIkGoals(condition, o.*options); }};
}

}  // namespace etude
