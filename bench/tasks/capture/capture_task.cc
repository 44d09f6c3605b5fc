#include <algorithm>

#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/capture/exchange.h"
#include "bench/tasks/capture/options.h"
#include "bench/tasks/capture/run.h"
#include "bench/tasks/capture/score.h"
#include "bench/tasks/capture/stages.h"
#include "bench/tasks/capture/take_cameras.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct CaptureStudy {
  StudioOptions options;
  std::vector<CaptureMethod> methods;
  std::vector<PersonSource>
      sources;  ///< the sources of all methods; equal sources are listed once, and their marks are shared
  ClipLibrary clips;
};

/// Returns the reason why no method can be judged in this world; nothing if methods can be judged.
std::optional<std::string> WhyUnjudged(const CaptureWorld& world) {
  if (std::ranges::find(world.in_view, true) != world.in_view.end()) return std::nullopt;
  return "in no frame is the whole performer in the pictures of two cameras";
}

class CaptureTaskWorld : public TaskWorld {
 public:
  CaptureTaskWorld(const CaptureStudy& study, const LibraryClip& clip, const WorldKey& key, bool keeps_motion)
      : study_(study),
        key_(key),
        stages_(study.options, MakeCaptureWorld(study.options, clip, key), key, study.sources, keeps_motion),
        keeps_motion_(keeps_motion) {}

  void PrepareShared() override {
    if (!study_.sources.empty()) (void)stages_.GetTake();  // a failure is ignored here, because every cell reports it
  }

  CellResult Run(std::size_t method) override {
    if (const auto reason = WhyUnjudged(stages_.world())) return CellResult::Ended(Status::kSkipped, *reason);
    const auto run = RunCapture(stages_, study_.methods[method]);
    if (!run) return CellResult::Ended(Status::kFailed, run.error().message);
    return ScoreCaptureRun(stages_.world(), *run, keeps_motion_, study_.options.moments);
  }

  Result<CellResult> RunWith(LiveProgram& program, std::size_t method) override {
    if (const auto reason = WhyUnjudged(stages_.world())) return CellResult::Ended(Status::kSkipped, *reason);
    SeatedSegmenter segmenter(program);
    CaptureMethod seated = study_.methods[method];
    seated.program = &segmenter;
    const std::vector<PersonSource> sources = {PersonSourceOf(seated)};
    CaptureStages stages(study_.options, stages_.world(), key_, sources, keeps_motion_);
    const auto run = RunCapture(stages, seated);
    RETURN_IF_ERROR(segmenter.complaint());
    if (!run) return CellResult::Ended(Status::kFailed, run.error().message);
    return ScoreCaptureRun(stages.world(), *run, keeps_motion_, study_.options.moments);
  }

  Result<Payload> MakeProblem() override { return MakeCaptureProblem(study_.options, key_, stages_); }
  Result<Payload> MakeTruth() override { return MakeCaptureTruth(stages_); }
  Result<void> MakeTruePictures(const AttachmentSink& keep) override {
    return MakeCapturePictures(study_.options, key_, stages_, keep);
  }

  Result<CellResult> Judge(const Json& json) override {
    if (const auto reason = WhyUnjudged(stages_.world())) return CellResult::Ended(Status::kSkipped, *reason);
    ASSIGN_OR_RETURN(const auto answer, ReadCaptureAnswer(json, stages_.world().truth.size()));
    return ScoreCaptureAnswer(stages_.world(), answer, keeps_motion_);
  }

 private:
  const CaptureStudy& study_;
  const WorldKey key_;
  CaptureStages stages_;
  const bool keeps_motion_;
};

class CaptureTask : public Task {
 public:
  explicit CaptureTask(CaptureStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<CaptureTaskWorld>(study_, study_.clips.InTurn(key.trial), key, keeps_motion);
  }

  std::vector<std::string> ClipsOf(const WorldKey& key) const override { return {study_.clips.InTurn(key.trial).name}; }

  Result<Payload> Setting() const override { return DescribeStudio(); }

  std::optional<double> ValueOfFailure(std::string_view metric) const override {
    if (metric == "frames_recovered") return 0;
    return std::nullopt;
  }

 private:
  const CaptureStudy study_;
};

Result<void> CheckFigures(const TaskInput& input) {
  for (const LibraryClip& clip : input.clips.clips) {
    if (clip.figure != nullptr) continue;
    return Fail(input.condition.node().Find("figure")->place,
                "'figure: own' needs clips with meshes (glTF), but '{}' has no mesh", clip.source);
  }
  return {};
}

Result<std::unique_ptr<Task>> MakeCaptureTask(TaskInput& input) {
  CaptureStudy study;
  CaptureConditionFields().Read(input.condition, study.options);
  RETURN_IF_ERROR(OpenOwnCameras(input, study.options));
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "capture", SeatedCaptureMethodFields()));
  if (input.clips.clips.empty()) {
    return Fail(input.condition.node().place, "a scenario of task capture needs 'clips', such as ['builtin:boxing']");
  }
  if (study.options.figure == PerformerFigure::kOwn) RETURN_IF_ERROR(CheckFigures(input));
  study.methods = std::move(methods);
  for (std::size_t i = 0; i < study.methods.size(); ++i) {
    RETURN_IF_ERROR(CheckMarks(study.options, study.methods[i], input.methods[i].place));
    if (study.methods[i].seat == CaptureSeat::kNone) AddSource(PersonSourceOf(study.methods[i]), study.sources);
  }
  study.clips = input.clips;
  return std::make_unique<CaptureTask>(std::move(study));
}

}  // namespace

TaskKind MakeCaptureTaskKind() {
  return {.name = "capture",
          .question = "How close is the skeleton that is recovered from two or more cameras to the true skeleton?",
          .default_metrics = {"mpjpe_mm", "mpjpe_before_ik_mm", "pa_mpjpe_mm", "pck_50mm", "position_error_cm",
                              "frames_recovered"},
          .success = "frames_recovered",
          .metrics = CaptureMetrics(),
          .make = MakeCaptureTask,
          .condition_keys = CaptureConditionFields().Describe(),
          .method_keys = SeatedCaptureMethodFields().Describe(),
          .seats = CaptureSeatNames(),
          .units = {SamplingUnit::kClip, SamplingUnit::kLibrary, SamplingUnit::kWorld},
          .platform = RendererVersion};
}

}  // namespace etude
