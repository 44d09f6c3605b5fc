#include "tests/reports/films/race_run.h"

#include <algorithm>
#include <cmath>

#include "bench/model/recording.h"
#include "bench/recordings/task_extras.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

Recording RecordSettling(const Settling& cell) {
  const KinematicTree tree = MakeBodyTree({});
  TreeState state = StandingState(tree);
  const BodyPose truth = ToBodyPose(tree, state);
  Track truths{"truth", {}}, starts{"start", {}}, solutions{"solution", {}};
  IkExtras extras{.iterations = cell.iterations};
  for (const int iteration : cell.iterations) {
    const double left = std::exp(-cell.rate * iteration);
    for (std::size_t i = 0; i < state.angles.size(); ++i)
      state.angles[i] = 0.3 * left * std::sin(static_cast<double>(i));
    truths.motion.poses.push_back(truth);
    solutions.motion.poses.push_back(ToBodyPose(tree, state));
    starts.motion.poses.push_back(solutions.motion.poses.front());
    extras.position_error_max_cm.push_back(20 * left);
    extras.axis_error_max_deg.push_back(40 * left);
  }
  for (const Effector& effector : tree.effectors) {
    extras.targets_m.emplace_back(truth[BodyTreeLimbs()[effector.joint].to]);
  }
  return {{truths, starts, solutions}, WriteExtras(extras)};
}

}  // namespace

RunData RaceRun(const std::vector<Settling>& cells) {
  RunData run{.suite = "race"};
  ScenarioSummary& scenario = run.scenarios.emplace_back();
  scenario.name = "race";
  scenario.task = "ik";
  scenario.question = "Who settles first?";
  for (const Settling& cell : cells) {
    if (std::ranges::find(scenario.methods, cell.method) == scenario.methods.end())
      scenario.methods.push_back(cell.method);
    Row row;
    row.scenario = "race";
    row.task = "ik";
    row.trial = cell.trial;
    row.method = cell.method;
    row.result.status = cell.status;
    row.result.reason = cell.reason;
    if (!cell.iterations.empty()) run.recordings.push_back({row.Id(), RecordSettling(cell)});
    run.rows.push_back(std::move(row));
  }
  return run;
}

std::vector<int> EveryIteration(int last) {
  std::vector<int> iterations;
  for (int i = 0; i <= last; ++i) iterations.push_back(i);
  return iterations;
}

}  // namespace etude
