#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/tracking/exchange.h"
#include "bench/tasks/tracking/options.h"
#include "bench/tasks/tracking/run.h"
#include "bench/tasks/tracking/world.h"
#include "engine/formats/bvh.h"
#include "engine/kinematics/body_tree.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct TrackingStudy {
  TrackingOptions options;
  std::vector<TrackingMethod> methods;
  ClipLibrary clips;
};

class TrackingTaskWorld : public TaskWorld {
 public:
  TrackingTaskWorld(const TrackingStudy& study, const LibraryClip& clip, const WorldKey& key, bool keeps_motion)
      : study_(study), world_(MakeTrackingWorld(study.options, clip, key)), keeps_motion_(keeps_motion) {}

  std::optional<std::string> WhySkipped() const override {
    if (world_) return std::nullopt;
    return world_.error().message;
  }

  CellResult Run(std::size_t method) override {
    const auto answer = Follow(*world_, study_.methods[method]);
    if (!answer) return CellResult::Ended(Status::kFailed, answer.error().message);
    return ScoreTracking(*world_, study_.options.rate_hz, *answer, keeps_motion_);
  }

  Result<Payload> MakeProblem() override { return DescribeMotion(*world_); }
  Result<Payload> MakeTruth() override {
    Payload truth = DescribeTrueAngles(*world_);
    const Clip clip = ToClip(world_->tree, world_->truth, study_.options.rate_hz, "truth");
    truth.files.push_back({"truth.bvh", WriteBvh(clip)});
    return truth;
  }

  Result<CellResult> Judge(const Json& json) override {
    ASSIGN_OR_RETURN(const auto answer, ReadTrackingAnswer(json, *world_));
    return ScoreTracking(*world_, study_.options.rate_hz, answer, keeps_motion_);
  }

 private:
  const TrackingStudy& study_;
  const Result<TrackingWorld> world_;
  const bool keeps_motion_;
};

class TrackingTask : public Task {
 public:
  explicit TrackingTask(TrackingStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<TrackingTaskWorld>(study_, study_.clips.InTurn(key.trial), key, keeps_motion);
  }

  std::vector<std::string> ClipsOf(const WorldKey& key) const override { return {study_.clips.InTurn(key.trial).name}; }

  Result<Payload> Setting() const override { return DescribeTrackingSetting(study_.options, study_.options.common); }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    return TrackingValueOfFailure(metric);
  }

 private:
  const TrackingStudy study_;
};

Result<std::unique_ptr<Task>> MakeTrackingTask(TaskInput& input) {
  TrackingStudy study;
  TrackingConditionFields().Read(input.condition, study.options);
  TrackingMethod start;
  start.options = study.options.common;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "tracking", TrackingMethodFields(), start));
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place, "a scenario of task tracking needs 'clips', such as ['builtin:boxing']");
  }
  study.methods = std::move(methods);
  study.clips = input.clips;
  return std::make_unique<TrackingTask>(std::move(study));
}

}  // namespace

TaskKind MakeTrackingTaskKind() {
  return {.name = "tracking",
          .question = "How well does a solver follow a motion frame by frame?",
          .default_metrics = {"frames_solved", "mpjpe_mm", "orientation_error_deg", "position_error_cm",
                              "angle_jerk_ratio", "iterations_per_frame"},
          .success = "frames_solved",
          .metrics = TrackingMetrics(),
          .make = MakeTrackingTask,
          .condition_keys = TrackingConditionFields().Describe(),
          .method_keys = TrackingMethodFields().Describe(),
          .units = {SamplingUnit::kClip, SamplingUnit::kLibrary, SamplingUnit::kWorld}};
}

}  // namespace etude
