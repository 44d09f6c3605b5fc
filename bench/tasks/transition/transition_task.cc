#include "bench/tasks/base/fuzzy_key.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/transition/exchange.h"
#include "bench/tasks/transition/run.h"
#include "bench/training/training_pairs.h"

namespace etude {
namespace {

class TransitionTask final : public Task {
 public:
  TransitionTask(std::vector<TransitionMethod> methods, double max_wait_s, bool explain, Stage stage,
                 TrainingClips training)
      : methods_(std::move(methods)),
        max_wait_s_(max_wait_s),
        explain_(explain),
        stage_(std::move(stage)),
        learnt_(std::move(training), stage_.fuzzy) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    const TransitionBasis basis{methods_, stage_, learnt_, max_wait_s_, explain_};
    return std::make_unique<TransitionRun>(basis, DrawRequest(stage_, key), keeps_motion);
  }

  /// Returns the names of the playing clip and the wanted clip, in this order.
  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    const std::vector<std::string>& names = stage_.library.names;
    if (names.empty()) return {};
    const auto request = DrawRequest(stage_, key);
    if (!request) return {names[FromClip(stage_, key)]};
    return {names[request->from], names[request->to]};
  }

  Result<Payload> Setting() const override { return StagePayload(stage_); }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    return TransitionFailureValue(metric);
  }

 private:
  const std::vector<TransitionMethod> methods_;
  const double max_wait_s_;
  const bool explain_;
  const Stage stage_;
  mutable LearntWeights learnt_;
};

/// Refuses the condition's key `threshold` if no method reads it.
void CheckThreshold(TaskInput& input, std::span<const TransitionMethod> methods) {
  const Node* threshold = input.condition.Raw("threshold");
  bool is_read = false;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    is_read |= methods[m].way.choice->uses_fuzzy && input.methods[m].Find("threshold") == nullptr;
  }
  if (threshold != nullptr && !is_read && !methods.empty()) {
    input.condition.Complain(threshold->place,
                             "'threshold' has no effect here, because no method takes its threshold from the scenario");
  }
}

Result<std::unique_ptr<Task>> MakeTransitionTask(TaskInput& input) {
  TransitionCondition condition;
  TransitionConditionFields().Read(input.condition, condition);
  ASSIGN_OR_RETURN(condition.stage.fuzzy, FuzzySystemOf(input));
  TransitionMethod start;
  start.way.rules.threshold = condition.threshold;
  start.wait_s = condition.wait_s;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "transition", TransitionMethodFields(), start));
  CheckThreshold(input, methods);
  if (!input.condition.ok()) return tl::unexpected(input.condition.Finish().error());
  Stage stage = SetStage(input.clips, condition.stage);
  ASSIGN_OR_RETURN(auto training,
                   GatherTrainingClips(stage.library.motions, stage.identities, stage.library.proportions));
  return std::make_unique<TransitionTask>(std::move(methods), condition.wait_s, condition.explain, std::move(stage),
                                          std::move(training));
}

}  // namespace

TaskKind MakeTransitionTaskKind() {
  return {.name = "transition",
          .question = "How smoothly does a body change from one clip to another clip on request?",
          .default_metrics = {"jump_cm", "natural_share", "pose_gap_cm", "false_smooth", "foot_slide_cmps", "wait_s"},
          .success = "clean_share",
          .metrics = TransitionMetrics(),
          .make = MakeTransitionTask,
          .condition_keys = TransitionConditionFields().Describe(),
          .method_keys = TransitionMethodFields().Describe(),
          .units = {SamplingUnit::kClipPair, SamplingUnit::kClip, SamplingUnit::kLibrary, SamplingUnit::kWorld}};
}

}  // namespace etude
