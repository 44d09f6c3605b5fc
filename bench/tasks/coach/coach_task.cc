#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/coach/exchange.h"
#include "bench/tasks/coach/operating_point.h"
#include "bench/tasks/coach/options.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/coach/world.h"

namespace etude {
namespace {

constexpr const char* kOnlyLive =
    "a session depends on the method's answers, so etude cannot write the problem before the session";

/// The data that all worlds of one condition share.
struct Rehearsal {
  CoachCondition condition;
  std::shared_ptr<const CoachStage> stage;
  std::vector<CoachMethod> methods;
};

/// Keeps the prepared coaches of one condition (`Rehearsal`), by scenario and seed. The coaches are made at the first
/// request. If there is an operating point, their thresholds are set on sessions with people who are not judged.
class ReadyCoaches {
 public:
  /// `rehearsal` must outlive this object.
  explicit ReadyCoaches(const Rehearsal& rehearsal) : rehearsal_(rehearsal) {}

  /// Returns the coaches for worlds of this scenario and seed. Fails if a method's recogniser cannot be taught.
  Result<std::vector<ReadyCoach>*> For(const WorldKey& key) {
    const auto [known, is_new] = known_.try_emplace({key.suite_seed, std::string(key.scenario)});
    if (is_new) {
      std::vector<CoachMethod> methods = rehearsal_.methods;
      RETURN_IF_ERROR(SetThresholds(rehearsal_.condition, *rehearsal_.stage, key, methods));
      ASSIGN_OR_RETURN(known->second, MakeReady(std::move(methods), *rehearsal_.stage));
    }
    return &known->second;
  }

 private:
  const Rehearsal& rehearsal_;
  std::map<std::pair<Seed, std::string>, std::vector<ReadyCoach>> known_;
};

class CoachTaskWorld final : public TaskWorld {
 public:
  CoachTaskWorld(const Rehearsal& shared, ReadyCoaches& coaches, const WorldKey& key, bool keeps_motion)
      : shared_(shared),
        coaches_(coaches),
        world_(MakeCoachWorld(shared.condition, key)),
        keeps_motion_(keeps_motion) {}

  /// Makes the coaches, which all worlds of the condition share.
  void PrepareShared() override { Coaches(); }

  CellResult Run(std::size_t method) override {
    const auto log = RunMethod(Coaches()[method], shared_.condition, *shared_.stage, world_, nullptr);
    if (!log) return CellResult::Ended(Status::kFailed, log.error().message);
    return Score(*log);
  }

  Result<CellResult> RunWith(LiveProgram& program, std::size_t method) override {
    ASSIGN_OR_RETURN(const SessionLog log,
                     RunMethod(Coaches()[method], shared_.condition, *shared_.stage, world_, &program));
    return Score(log);
  }

  Result<Payload> MakeProblem() override { return Fail({}, "{}", kOnlyLive); }
  Result<Payload> MakeTruth() override { return Fail({}, "{}", kOnlyLive); }
  Result<CellResult> Judge(const Json&) override { return Fail({}, "{}", kOnlyLive); }

 private:
  CellResult Score(const SessionLog& log) const {
    if (log.modes.empty()) return CellResult::Ended(Status::kFailed, "the session did not begin");
    CellResult result = CellResult::Ended(Status::kOk, "");
    ScoreCoaching(world_, *shared_.stage, log, result);
    if (keeps_motion_) result.recording = RecordCoaching(*shared_.stage, log);
    return result;
  }

  /// Returns the coaches. This cannot fail, because MakeCoachTask has checked that all recognisers can be taught.
  const std::vector<ReadyCoach>& Coaches() const { return **coaches_.For(world_.key); }

  const Rehearsal& shared_;
  ReadyCoaches& coaches_;
  const CoachWorld world_;
  const bool keeps_motion_;
};

class CoachTask final : public Task {
 public:
  explicit CoachTask(Rehearsal shared) : shared_(std::move(shared)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<CoachTaskWorld>(shared_, coaches_, key, keeps_motion);
  }
  std::vector<std::string> ClipsOf(const WorldKey& /*key*/) const override { return {}; }
  Result<Payload> Setting() const override { return DancePayload(*shared_.stage); }

 private:
  const Rehearsal shared_;
  mutable ReadyCoaches coaches_{shared_};  // a cache whose content depends on keys alone
};

/// Returns the stage of a song. All conditions with this song share it.
Result<std::shared_ptr<const CoachStage>> SharedStage(const std::string& song) {
  static std::map<std::string, std::weak_ptr<const CoachStage>> stages;
  if (auto known = stages[song].lock()) return known;
  ASSIGN_OR_RETURN(auto stage, SetCoachStage(song));
  auto made = std::make_shared<const CoachStage>(std::move(stage));
  stages[song] = made;
  return made;
}

Result<std::unique_ptr<Task>> MakeCoachTask(TaskInput& input) {
  // Read the condition and the methods.
  Rehearsal shared;
  ASSIGN_OR_RETURN(shared.condition.sight.sensor, SensorOf(input));
  CoachConditionFields().Read(input.condition, shared.condition);
  CoachMethod start;
  start.sight.threshold = shared.condition.sight.threshold;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "coach", CoachMethodFields(), start));
  const auto sight = [](const CoachMethod& method) -> const DetectionMethod& { return method.sight; };
  // Prepare the cameras, and refuse settings that do not work with cameras.
  RETURN_IF_ERROR(PrepareCameras(input, methods, sight, shared.condition.sight));
  for (std::size_t i = 0; i < methods.size() && shared.condition.sight.has_cameras; ++i) {
    if (methods[i].sight.sees_truth || methods[i].sight.Capture().causal) continue;
    return Fail(input.methods[i].place,
                "method {}: with cameras, a coach needs 'capture' with 'causal: true', because a coach cannot wait for "
                "later pictures",
                methods[i].name);
  }
  if (shared.condition.sight.has_cameras && shared.condition.operating_point) {
    return Fail(input.condition.node().place,
                "'operating_point' is not allowed with cameras, because every method then has its own skeletons; use "
                "'threshold'");
  }
  // Set the stage, and check that every recogniser can be taught.
  ASSIGN_OR_RETURN(shared.stage, SharedStage(shared.condition.song));
  if (const auto ready = MakeReady(methods, *shared.stage); !ready) {
    return Fail(input.condition.node().place, "{}", ready.error().message);
  }
  shared.methods = std::move(methods);
  return std::make_unique<CoachTask>(std::move(shared));
}

}  // namespace

TaskKind MakeCoachTaskKind() {
  return {.name = "coach",
          .question = "Does coaching improve the learner?",
          .default_metrics = {"retention", "answered_share", "corrections_unneeded_per_min"},
          .success = "retention",
          .metrics = CoachMetrics(),
          .make = MakeCoachTask,
          .condition_keys = CoachConditionFields().Describe(),
          .method_keys = CoachMethodFields().Describe(),
          .seats = SeatNames(),
          .has_problems = false,
          .uses_clips = false,
          .units = {SamplingUnit::kPerson}};
}

}  // namespace etude
