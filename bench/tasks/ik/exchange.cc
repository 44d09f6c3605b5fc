#include "bench/tasks/ik/exchange.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "bench/recordings/task_extras.h"
#include "bench/tasks/base/answer_fields.h"
#include "bench/tasks/base/tree_json.h"
#include "engine/base/angles.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

constexpr std::size_t kMaxRecordedSteps = 150;
constexpr int kEveryUpTo = 60;

/// Lists every iteration up to kEveryUpTo. After that, the iteration following i is i + max(1, i / `share`). The last
/// iteration is always listed.
std::vector<int> Growing(int last, int share) {
  std::vector<int> iterations;
  for (int i = 0; i < last; i += i < kEveryUpTo ? 1 : std::max(1, i / share)) iterations.push_back(i);
  iterations.push_back(last);
  return iterations;
}

std::optional<int> ReadCount(AnswerFields& fields, const char* key) {
  constexpr int kMaxCount = 1'000'000'000;
  if (!fields.Has(key)) return std::nullopt;
  return fields.Integer(key, 0, kMaxCount);
}

}  // namespace

Payload DescribeIkSetting(const KinematicTree& tree, const IkOptions& options, const IkTrialOptions& trial) {
  Json setting = DescribeBodyTree(tree);
  setting.update(DescribeGoals(options));
  Json& asked = setting["asked"] = Json::array();
  if (trial.asks_positions) asked.push_back("position");
  if (trial.asks_axes) asked.push_back("orientation");
  return PayloadOf(std::move(setting));
}

Payload DescribeProblem(const KinematicTree& tree, const IkProblem& problem) {
  return PayloadOf({{"root", DescribeRoot(problem.start)},
                    {"start_angles_deg", InDegrees(problem.start.angles)},
                    {"targets", DescribeTargets(tree, problem.targets)}});
}

Payload DescribeTruth(const IkWorld& world) { return PayloadOf({{"angles_deg", InDegrees(world.truth.angles)}}); }

Result<IkAnswer> ReadIkAnswer(const Json& json, const KinematicTree& tree) {
  AnswerFields fields(json);
  IkAnswer answer;
  const Json& degrees = fields.List("angles_deg", tree.limits.size(), tree.limits.size());
  answer.iterations = ReadCount(fields, "iterations");
  answer.fk_evaluations = ReadCount(fields, "fk_evaluations");
  RETURN_IF_ERROR(fields.Finish());
  ASSIGN_OR_RETURN(auto angles, ReadDegrees(degrees, "angles_deg", tree.limits.size()));
  answer.angles = std::move(angles);
  return answer;
}

std::vector<int> RecordedIterations(int last) {
  for (int share = 2 * kEveryUpTo;; share /= 2) {
    std::vector<int> iterations = Growing(last, share);
    // With share 1, each listed iteration is twice the previous one, so the list is always short enough.
    if (iterations.size() <= kMaxRecordedSteps || share == 1) return iterations;
  }
}

std::vector<IkRecordedStep> StepsOf(std::span<const IkTraceEntry> trace) {
  std::vector<IkRecordedStep> steps;
  for (const int iteration : RecordedIterations(static_cast<int>(trace.size()) - 1)) {
    const IkTraceEntry& entry = trace[static_cast<std::size_t>(iteration)];
    steps.push_back({iteration, entry.angles, 100 * entry.worst_position, Degrees(entry.worst_mean_axis),
                     Degrees(entry.worst_axis)});
  }
  return steps;
}

Recording RecordIk(const KinematicTree& tree, const IkWorld& world, std::span<const IkRecordedStep> steps) {
  Track truth{"truth", {}}, start{"start", {}}, solution{"solution", {}};
  TreeState state = world.problem.start;
  const BodyPose true_pose = ToBodyPose(tree, world.truth), start_pose = ToBodyPose(tree, state);
  IkExtras extras;
  for (const IkRecordedStep& step : steps) {
    state.angles = step.angles;
    truth.motion.poses.push_back(true_pose);
    start.motion.poses.push_back(start_pose);
    solution.motion.poses.push_back(ToBodyPose(tree, state));
    extras.iterations.push_back(step.iteration);
    extras.position_error_max_cm.push_back(step.position_error_max_cm);
    extras.orientation_error_max_deg.push_back(step.orientation_error_max_deg);
    extras.axis_error_max_deg.push_back(step.axis_error_max_deg);
  }
  // Record the targets too, because noise may have moved them away from the true pose.
  for (const EffectorTarget& target : world.problem.targets) {
    auto& target_m = extras.targets_m.emplace_back();
    if (target.position_weight > 0) target_m = target.position;
  }
  return {{std::move(truth), std::move(start), std::move(solution)}, WriteExtras(extras)};
}

}  // namespace etude
