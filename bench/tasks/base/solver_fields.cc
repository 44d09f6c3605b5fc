#include "bench/tasks/base/solver_fields.h"

#include "bench/tasks/base/misplaced_keys.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr const char* kDefaultSolver = "gauss-newton";

void ReadSetting(Fields& fields, const IkSetting& setting, IkTuning& tuning) {
  if (const auto* integer = std::get_if<int IkTuning::*>(&setting.member)) {
    int& value = tuning.**integer;
    value = fields.Integer(setting.key, value, {setting.lowest, setting.largest});
  } else {
    double& value = tuning.*std::get<double IkTuning::*>(setting.member);
    value = fields.Number(setting.key, value, {setting.lowest, setting.largest});
  }
}

}  // namespace

const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options) {
  const IkSolver* solver = FindIkSolver(fields.Choice("solver", IkSolverNames(), kDefaultSolver));
  if (solver->uses_weights) {
    options.weights = *FindWeightRule(fields.Choice("weights", WeightRuleNames(), "adaptive"));
    options.refresh = *FindWeightRefresh(fields.Choice("refresh", WeightRefreshNames(), "sweep"));
  }
  for (const IkSetting& setting : solver->settings) ReadSetting(fields, setting, options.tuning);
  RefuseMisplacedKeys(fields, IkSolverKeys(), "solver", solver->name);
  return solver;
}

std::vector<KeyInfo> IkSolverKeys() {
  KeyCondition weighing{"solver", {}};
  for (const IkSolver& solver : AllIkSolvers()) {
    if (solver.uses_weights) weighing.values.push_back(solver.name);
  }
  std::vector<KeyInfo> keys = {
      {"solver", Join(IkSolverNames()), kDefaultSolver, "How the angles are found."},
      {"weights", Join(WeightRuleNames()), "adaptive", "How an effector's position counts against its axes.", weighing},
      {"refresh", Join(WeightRefreshNames()), "sweep", "When errors are measured anew for weights that follow them.",
       weighing}};
  const IkTuning defaults;
  for (const IkSolver& solver : AllIkSolvers()) {
    for (const IkSetting& setting : solver.settings) {
      const double fallback =
          std::visit([&](auto member) { return static_cast<double>(defaults.*member); }, setting.member);
      keys.push_back({setting.key,
                      fmt::format("{}…{}", setting.lowest, setting.largest),
                      fmt::format("{}", fallback),
                      setting.meaning,
                      {"solver", {solver.name}}});
    }
  }
  return keys;
}

void ReadIkGoals(Fields& condition, IkOptions& options) {
  if (condition.Choice("stop_at", {"practical", "tight"}, "practical") == "practical") return;
  options.position_goal = 1e-5;
  options.axis_goal = Radians(1e-3);
}

KeyInfo IkGoalsKey() {
  return {"stop_at", "practical, tight", "practical",
          "Solvers stop when every effector is within 0.1 cm and 0.1°, or within 10⁻³ cm and 10⁻³°."};
}

}  // namespace etude
