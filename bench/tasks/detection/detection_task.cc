#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/detection/exchange.h"
#include "bench/tasks/detection/operating_point.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/recorded_task.h"
#include "bench/tasks/detection/score.h"
#include "bench/tasks/detection/session_world.h"
#include "bench/tasks/detection/world.h"
#include "bench/tasks/sensing/camera_stream.h"

namespace etude {
namespace {

class DetectionTask final : public Task {
 public:
  DetectionTask(const DetectionOptions& options, std::vector<ReadyMethod> methods, Repertoire repertoire,
                const ClipLibrary& clips)
      : options_(options), methods_(std::move(methods)), repertoire_(std::move(repertoire)) {
    for (const LibraryClip& clip : clips.clips) clips_.push_back({clip.name, clip.move.has_value()});
  }

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    const TrialClip& clip = ClipAt(key);
    if (!clip.is_labelled) {
      return std::make_unique<SkippedWorld>(
          fmt::format("clip {} has no labelled moves: detection needs to know what was danced", clip.name));
    }
    const auto decide = [this, seed = key.suite_seed,
                         scenario = std::string(key.scenario)]() -> const std::vector<MethodDecision>& {
      return decisions_.For({seed, scenario, 0});
    };
    return std::make_unique<SessionWorld>(methods_, decide, repertoire_, MakeDetectionWorld(repertoire_, options_, key),
                                          keeps_motion);
  }

  /// Returns the world's clip if it has no labels, so that the world is skipped. Otherwise returns no clip, because a
  /// session mixes all labelled clips.
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
  mutable MethodDecisions decisions_{methods_, repertoire_, options_};  // a cache: an entry depends only on its key
  std::vector<TrialClip> clips_;
};

Result<std::unique_ptr<Task>> MakeDetectionTask(TaskInput& input) {
  DetectionOptions options;
  ASSIGN_OR_RETURN(options.sensor, SensorOf(input));
  DetectionConditionFields().Read(input.condition, options);
  DetectionMethod start;
  start.threshold = options.threshold;
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "detection", DetectionMethodFields(), start));
  if (input.recordings != nullptr) return MakeRecordedTask(input, options, std::move(methods));
  if (!options.moves.empty()) {
    return Fail(input.condition.node().Find(kMovesKey)->place, "'{}' is allowed only with 'streams' or 'labels'",
                kMovesKey);
  }
  RETURN_IF_ERROR(PrepareCameras(input, methods, std::identity(), options));
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place,
                "a scenario of task detection needs 'clips', such as ['builtin:*'], or 'streams'");
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
          .question = "Does the coach notice which moves people performed right, and how soon does it notice this?",
          .default_metrics = metrics,
          .success = "f1",
          .metrics = metrics,
          .make = MakeDetectionTask,
          .condition_keys = DetectionConditionFields().Describe(),
          .method_keys = DetectionMethodFields().Describe(),
          .uses_recordings = true,
          .units = {SamplingUnit::kPerson, SamplingUnit::kLibrary}};
}

}  // namespace etude
