#include "bench/tasks/coach/coach_task.h"

#include <utility>

#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/coach/exchange.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/recording.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/score.h"
#include "bench/tasks/coach/stage.h"
#include "bench/tasks/coach/world.h"

namespace etude {
namespace {

constexpr const char* kOnlyLive = "a session answers back: it has no problem that could be told beforehand";

/// Everything that the worlds of a condition share.
struct Rehearsal {
  CoachCondition condition;
  CoachStage stage;
  std::vector<ReadyCoach> coaches;
};

class CoachTaskWorld final : public TaskWorld {
 public:
  CoachTaskWorld(const Rehearsal& shared, const WorldKey& key, bool keeps_motion)
      : shared_(shared), world_(MakeCoachWorld(shared.condition, key)), keeps_motion_(keeps_motion) {}

  CellResult Run(std::size_t method) override {
    const auto log = RunMethod(shared_.coaches[method], shared_.condition, shared_.stage, world_, nullptr);
    if (!log) return CellResult::Ended(Status::kFailed, log.error().message);
    return Score(*log);
  }

  Result<CellResult> RunWith(LiveProgram& program, std::size_t method) override {
    ASSIGN_OR_RETURN(const SessionLog log,
                     RunMethod(shared_.coaches[method], shared_.condition, shared_.stage, world_, &program));
    return Score(log);
  }

  Result<Payload> MakeProblem() override { return Fail({}, "{}", kOnlyLive); }
  Result<Payload> MakeTruth() override { return Fail({}, "{}", kOnlyLive); }
  Result<CellResult> Judge(const Json&) override { return Fail({}, "{}", kOnlyLive); }

 private:
  CellResult Score(const SessionLog& log) const {
    if (log.modes.empty()) return CellResult::Ended(Status::kFailed, "the session did not begin");
    CellResult result = CellResult::Ended(Status::kOk, "");
    ScoreCoaching(world_, shared_.stage, log, result);
    if (keeps_motion_) result.recording = RecordCoaching(shared_.stage, log);
    return result;
  }

  const Rehearsal& shared_;
  const CoachWorld world_;
  const bool keeps_motion_;
};

class CoachTask final : public Task {
 public:
  explicit CoachTask(Rehearsal shared) : shared_(std::move(shared)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<CoachTaskWorld>(shared_, key, keeps_motion);
  }
  std::vector<std::string> ClipsOf(const WorldKey& /*key*/) const override { return {}; }
  Result<Payload> Setting() const override { return DancePayload(shared_.stage); }

 private:
  const Rehearsal shared_;
};

Result<std::unique_ptr<Task>> MakeCoachTask(TaskInput& input) {
  Rehearsal shared;
  ASSIGN_OR_RETURN(shared.condition.sight.sensor, SensorOf(input));
  CoachConditionFields().Read(input.condition, shared.condition);
  CoachMethod start;
  start.sight.threshold = shared.condition.sight.threshold;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "coach", CoachMethodFields(), start));
  const auto sight = [](const CoachMethod& method) -> const DetectionMethod& { return method.sight; };
  RETURN_IF_ERROR(BookCameras(input, methods, sight, shared.condition.sight));
  for (std::size_t i = 0; i < methods.size() && shared.condition.sight.has_cameras; ++i) {
    if (methods[i].sight.sees_truth || methods[i].sight.Capture().causal) continue;
    return Fail(input.methods[i].place,
                "method {}: a coach cannot wait for later pictures; allowed: 'capture' with 'causal: true'",
                methods[i].name);
  }
  ASSIGN_OR_RETURN(shared.stage, SetCoachStage(shared.condition.song));
  auto ready = MakeReady(std::move(methods), shared.stage);
  if (!ready) return Fail(input.condition.node().place, "{}", ready.error().message);
  shared.coaches = *std::move(ready);
  return std::make_unique<CoachTask>(std::move(shared));
}

}  // namespace

TaskKind MakeCoachTaskKind() {
  return {.name = "coach",
          .question = "Does the learner end up better for having been coached?",
          .default_metrics = {"retention", "answered_share", "corrections_unneeded_per_min"},
          .metrics = CoachMetrics(),
          .make = MakeCoachTask,
          .condition_keys = CoachConditionFields().Describe(),
          .method_keys = CoachMethodFields().Describe(),
          .seats = SeatNames(),
          .uses_clips = false,
          .units = {SamplingUnit::kPerson}};
}

}  // namespace etude
