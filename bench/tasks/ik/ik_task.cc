#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/ik/exchange.h"
#include "bench/tasks/ik/options.h"
#include "bench/tasks/ik/run.h"
#include "bench/tasks/ik/world.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct IkStudy {
  KinematicTree tree = MakeBodyTree({});  ///< the body, with the condition's limits
  IkCondition condition;
  std::vector<IkMethod> methods;
};

class IkTaskWorld : public TaskWorld {
 public:
  IkTaskWorld(const IkStudy& study, const WorldKey& key, bool keeps_motion)
      : study_(study), world_(MakeIkWorld(study.tree, study.condition.trial, key)), records_(study.condition.records) {
    records_.motion = keeps_motion;
  }

  CellResult Run(std::size_t method) override {
    return RunIkCell(study_.tree, world_, study_.methods[method], records_);
  }

  Result<Payload> MakeProblem() override { return DescribeProblem(study_.tree, world_.problem); }
  Result<Payload> MakeTruth() override { return DescribeTruth(world_); }

  Result<CellResult> Judge(const Json& json) override {
    ASSIGN_OR_RETURN(const auto answer, ReadIkAnswer(json, study_.tree));
    return ScoreIkAnswer(study_.tree, world_, answer, study_.condition.common.max_iterations, records_);
  }

 private:
  const IkStudy& study_;
  const IkWorld world_;
  IkRecords records_;
};

class IkTask : public Task {
 public:
  explicit IkTask(IkStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<IkTaskWorld>(study_, key, keeps_motion);
  }

  std::vector<std::string> ClipsOf(const WorldKey&) const override { return {}; }

  Result<Payload> Setting() const override {
    return DescribeIkSetting(study_.tree, study_.condition.common, study_.condition.trial);
  }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    return IkValueOfFailure(metric, study_.condition.common.max_iterations);
  }

 private:
  const IkStudy study_;
};

Result<std::unique_ptr<Task>> MakeIkTask(TaskInput& input) {
  IkStudy study;
  IkConditionFields().Read(input.condition, study.condition);
  study.tree.limits = JointLimits(study.condition.trial.limit_set);
  ASSIGN_OR_RETURN(auto methods, ReadIkMethods(input, study.condition));
  study.methods = std::move(methods);
  return std::make_unique<IkTask>(std::move(study));
}

}  // namespace

TaskKind MakeIkTaskKind() {
  return {.name = "ik",
          .question =
              "How close do the end effectors come to their targets, and how far from the truth are the angles that no "
              "target determines?",
          .default_metrics = {"orientation_error_deg", "position_error_cm", "hidden_angle_error_deg",
                              "solved_practical", "iterations"},
          .success = "solved_practical",
          .metrics = IkMetrics(),
          .make = MakeIkTask,
          .condition_keys = IkConditionFields().Describe(),
          .method_keys = IkMethodFields().Describe(),
          .uses_clips = false};
}

}  // namespace etude
