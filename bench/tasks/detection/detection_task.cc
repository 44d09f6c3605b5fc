#include "bench/tasks/detection/detection_task.h"

#include <fmt/format.h>

#include "bench/tasks/detection/judge.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/scoring.h"
#include "bench/tasks/detection/world.h"

namespace etude {
namespace {

class DetectionTask final : public Task {
 public:
  DetectionTask(const DetectionOptions& options, std::vector<DetectionMethod> methods, const ClipLibrary& clips,
                bool wants_recordings)
      : options_(options),
        methods_(std::move(methods)),
        repertoire_(RepertoireOf(clips)),
        wants_recordings_(wants_recordings) {
    for (const LibraryClip& clip : clips.clips) clips_.push_back({clip.name, clip.move.has_value()});
  }

  std::vector<CellResult> RunWorld(const WorldKey& key) const override {
    const TrialClip& clip = ClipAt(key);
    if (!clip.is_labelled) {
      const std::string reason =
          fmt::format("clip {} has no labelled moves: detection needs to know what was danced", clip.name);
      return std::vector<CellResult>(methods_.size(), Skip(reason));
    }
    const DetectionWorld world = MakeDetectionWorld(repertoire_, options_, key);
    const StageDigests world_digests = WorldDigests(world);
    std::vector<CellResult> results;
    for (const DetectionMethod& method : methods_) results.push_back(RunMethod(world, world_digests, method));
    return results;
  }

  /// A session mixes all labelled clips, so only a clip that has to be left out is named.
  std::string ClipOf(const WorldKey& key) const override {
    const TrialClip& clip = ClipAt(key);
    return clip.is_labelled ? "" : clip.name;
  }

 private:
  struct TrialClip {
    std::string name;
    bool is_labelled;
  };

  const TrialClip& ClipAt(const WorldKey& key) const {
    return clips_[static_cast<std::size_t>(key.trial) % clips_.size()];
  }

  CellResult RunMethod(const DetectionWorld& world, const StageDigests& world_digests,
                       const DetectionMethod& method) const {
    const SessionVerdict verdict = JudgeSession(world, repertoire_, method);
    CellResult result = CellResult::Ended(Status::kOk, "");
    ScoreSession(world, verdict, result);
    result.digests = world_digests;
    for (auto& stage : VerdictDigests(verdict)) result.digests.push_back(std::move(stage));
    result.series.push_back(ScoreSeries(world, verdict));
    if (wants_recordings_) result.recording = RecordSession(world, verdict);
    return result;
  }

  static CellResult Skip(const std::string& reason) {
    CellResult result = CellResult::Ended(Status::kSkipped, reason);
    MissAllDetectionMetrics(reason, result);
    return result;
  }

  const DetectionOptions options_;
  const std::vector<DetectionMethod> methods_;
  const Repertoire repertoire_;
  std::vector<TrialClip> clips_;
  const bool wants_recordings_;
};

Result<std::unique_ptr<Task>> MakeDetectionTask(TaskInput& input) {
  const DetectionOptions options = ReadDetectionOptions(input.condition);
  auto methods = ReadDetectionMethods(input.condition, input.methods);
  if (!input.condition.ok()) return tl::unexpected(input.condition.Finish().error());
  if (!methods) return tl::unexpected(methods.error());
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place, "task detection needs 'clips', such as ['builtin:*']");
  }
  return std::make_unique<DetectionTask>(options, *std::move(methods), input.clips, input.wants_recordings);
}

}  // namespace

TaskKind MakeDetectionTaskKind() {
  return {.name = "detection",
          .question = "Does the coach notice which moves were danced right, and how soon?",
          .default_metrics = {"f1", "precision", "recall", "roc_auc", "latency_s", "false_alarms_per_min"},
          .make = MakeDetectionTask,
          .method_keys = DetectionMethodKeys()};
}

}  // namespace etude
