#include "bench/tasks/base/solver_fields.h"

#include "bench/tasks/base/misplaced_keys.h"
#include "engine/base/names.h"

namespace etude {
namespace {

constexpr const char* kDefaultSolver = "gauss-newton";

double ReadSetting(Fields& fields, const NumberSetting& setting) {
  const Range range{setting.lowest, setting.largest};
  return setting.is_whole ? fields.Integer(setting.key, static_cast<int>(setting.fallback), range)
                          : fields.Number(setting.key, setting.fallback, range);
}

void RefuseFormerName(Fields& fields) {
  const Node* solver = fields.Raw("solver");
  const std::string_view now = solver == nullptr ? "" : NewNameOfIkSolver(solver->scalar);
  if (!now.empty()) fields.Complain(solver->place, fmt::format("solver '{}' was renamed to '{}'", solver->scalar, now));
}

}  // namespace

const IkSolver* ReadIkSolver(Fields& fields, IkOptions& options) {
  RefuseFormerName(fields);
  const IkSolver* solver = FindIkSolver(fields.Choice("solver", IkSolverNames(), kDefaultSolver));
  if (solver->uses_weights) {
    options.weights = *FindWeightRule(fields.Choice("weights", WeightRuleNames(), "adaptive"));
    options.refresh = *FindWeightRefresh(fields.Choice("refresh", WeightRefreshNames(), "sweep"));
  }
  for (const NumberSetting& setting : solver->settings) {
    options.solver_settings.push_back(ReadSetting(fields, setting));
  }
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
  for (const IkSolver& solver : AllIkSolvers()) {
    for (const NumberSetting& setting : solver.settings) {
      keys.push_back({setting.key,
                      fmt::format("{}…{}", setting.lowest, setting.largest),
                      fmt::format("{}", setting.fallback),
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
