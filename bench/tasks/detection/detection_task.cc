#include "bench/tasks/detection/detection_task.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <deque>

#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/detection/exchange.h"
#include "bench/tasks/detection/operating_point.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/run.h"
#include "bench/tasks/detection/score.h"
#include "bench/tasks/detection/world.h"
#include "bench/tasks/sensing/camera_stream.h"

namespace etude {
namespace {

/// A trial whose turn falls on a clip that nobody labelled.
class UnlabelledWorld final : public TaskWorld {
 public:
  explicit UnlabelledWorld(const std::string& clip)
      : reason_(fmt::format("clip {} has no labelled moves: detection needs to know what was danced", clip)) {}

  std::optional<std::string> WhySkipped() const override { return reason_; }
  CellResult Run(std::size_t) override { return CellResult::Ended(Status::kSkipped, reason_); }
  Result<Payload> MakeProblem() override { return Fail({}, "{}", reason_); }
  Result<Payload> MakeTruth() override { return Fail({}, "{}", reason_); }
  Result<CellResult> Judge(const Json&) override { return Fail({}, "{}", reason_); }

 private:
  std::string reason_;
};

/// One session, and the methods run and judged in it.
class DetectionTaskWorld final : public TaskWorld {
 public:
  /// The first three must outlive this.
  DetectionTaskWorld(const std::vector<ReadyMethod>& methods, MethodDecisions& decisions, const Repertoire& repertoire,
                     const WorldKey& key, DetectionWorld world, bool keeps_motion)
      : methods_(methods),
        decisions_(decisions),
        repertoire_(repertoire),
        suite_seed_(key.suite_seed),
        scenario_(key.scenario),
        world_(std::move(world)),
        keeps_motion_(keeps_motion) {}

  /// The thresholds, which all worlds of the condition share, and the pictures.
  void PrepareShared() override {
    decisions_.For({suite_seed_, scenario_, 0});
    if (world_.cameras != nullptr) world_.cameras->Film();
  }

  CellResult Run(std::size_t index) override {
    const auto& [method, recogniser] = methods_[index];
    if (world_.cameras != nullptr && !method.sees_truth) {
      const auto& captured = world_.cameras->See(method.Capture());
      if (!captured) return CellResult::Ended(Status::kFailed, captured.error().message);
    }
    const DecisionOptions& decision = decisions_.For({suite_seed_, scenario_, 0})[index];
    return Score(JudgeSession(world_, SeenBy(method), repertoire_, *recogniser, decision));
  }

  Result<Payload> MakeProblem() override {
    if (world_.cameras == nullptr) return SessionPayload(world_);
    return Fail({}, "before cameras every method makes skeletons of its own: there is no stream that could be told");
  }
  Result<Payload> MakeTruth() override { return TruthPayload(world_); }

  Result<CellResult> Judge(const Json& answer) override {
    ASSIGN_OR_RETURN(const auto verdict, ReadSessionAnswer(answer, world_, repertoire_));
    return Score(verdict);
  }

 private:
  const SeenStream& SeenBy(const DetectionMethod& method) {
    const auto same = [&](const Sighted& known) {
      return known.filter == method.filter && known.sees_truth == method.sees_truth && known.capture == method.capture;
    };
    auto found = std::ranges::find_if(seen_, same);
    if (found == seen_.end()) {
      found = seen_.insert(found, {method.filter, method.sees_truth, method.capture, SeeSession(world_, method)});
    }
    return found->seen;
  }

  CellResult Score(const SessionVerdict& verdict) const {
    CellResult result = CellResult::Ended(Status::kOk, "");
    ScoreSession(world_, verdict, repertoire_, result);
    result.digests = world_digests_;
    for (auto& stage : VerdictDigests(verdict, repertoire_)) result.digests.push_back(std::move(stage));
    result.series = PerformanceSeries(world_, verdict, repertoire_);
    result.series.push_back(ScoreSeries(world_, verdict));
    if (keeps_motion_) result.recording = RecordSession(world_, verdict, repertoire_);
    return result;
  }

  struct Sighted {
    FilterOptions filter;
    bool sees_truth;
    std::optional<CaptureMethod> capture;
    SeenStream seen;
  };

  const std::vector<ReadyMethod>& methods_;
  MethodDecisions& decisions_;
  const Repertoire& repertoire_;
  const std::uint64_t suite_seed_;
  const std::string scenario_;
  const DetectionWorld world_;
  const StageDigests world_digests_ = WorldDigests(world_);
  const bool keeps_motion_;
  std::deque<Sighted> seen_;  ///< methods with the same filter, oracle and capture share one
};

class DetectionTask final : public Task {
 public:
  DetectionTask(const DetectionOptions& options, std::vector<ReadyMethod> methods, Repertoire repertoire,
                const ClipLibrary& clips)
      : options_(options), methods_(std::move(methods)), repertoire_(std::move(repertoire)) {
    for (const LibraryClip& clip : clips.clips) clips_.push_back({clip.name, clip.move.has_value()});
  }

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    const TrialClip& clip = ClipAt(key);
    if (!clip.is_labelled) return std::make_unique<UnlabelledWorld>(clip.name);
    return std::make_unique<DetectionTaskWorld>(methods_, decisions_, repertoire_, key,
                                                MakeDetectionWorld(repertoire_, options_, key), keeps_motion);
  }

  /// A session mixes all labelled clips, so only a clip that has to be left out is named.
  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    const TrialClip& clip = ClipAt(key);
    if (clip.is_labelled) return {};
    return {clip.name};
  }

  Result<Payload> Setting() const override { return MovesPayload(repertoire_.moves); }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    const SessionOptions& session = options_.session;  // PlanSession rounds the share to whole events
    return DetectionFailureValue(metric, std::lround(session.fault_share * session.events) < session.events);
  }

 private:
  struct TrialClip {
    std::string name;
    bool is_labelled;
  };

  const TrialClip& ClipAt(const WorldKey& key) const {
    return clips_[static_cast<std::size_t>(key.trial) % clips_.size()];
  }

  const DetectionOptions options_;
  const std::vector<ReadyMethod> methods_;
  const Repertoire repertoire_;
  mutable MethodDecisions decisions_{methods_, repertoire_, options_};  // a memory of what depends on keys alone
  std::vector<TrialClip> clips_;
};

Result<std::unique_ptr<Task>> MakeDetectionTask(TaskInput& input) {
  DetectionOptions options;
  ASSIGN_OR_RETURN(options.sensor, SensorOf(input));
  DetectionConditionFields().Read(input.condition, options);
  DetectionMethod start;
  start.threshold = options.threshold;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "detection", DetectionMethodFields(), start));
  RETURN_IF_ERROR(BookCameras(input, methods, std::identity(), options));
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place, "task detection needs 'clips', such as ['builtin:*']");
  }
  Repertoire repertoire = RepertoireOf(input.clips);
  std::vector<ReadyMethod> ready;
  for (DetectionMethod& method : methods) {
    auto recogniser = MakeRecogniser(method.recogniser, repertoire.taught);
    if (!recogniser)
      return Fail(input.condition.node().place, "method {}: {}", method.name, recogniser.error().message);
    ready.push_back({std::move(method), *std::move(recogniser)});
  }
  return std::make_unique<DetectionTask>(options, std::move(ready), std::move(repertoire), input.clips);
}

}  // namespace

TaskKind MakeDetectionTaskKind() {
  const std::vector<std::string> metrics = DetectionMetrics();
  return {.name = "detection",
          .question = "Does the coach notice which moves were performed right, and how soon?",
          .default_metrics = metrics,
          .metrics = metrics,
          .make = MakeDetectionTask,
          .condition_keys = DetectionConditionFields().Describe(),
          .method_keys = DetectionMethodFields().Describe(),
          .units = {SamplingUnit::kPerson, SamplingUnit::kLibrary}};
}

}  // namespace etude
