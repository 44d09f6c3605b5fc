#include "bench/tasks/base/file_task.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/plausibility/find_clips.h"
#include "bench/tasks/plausibility/judge.h"
#include "bench/tasks/plausibility/options.h"
#include "io/clips/body_in_place.h"

namespace etude {
namespace {

using PlausibilityStudy = FileStudy<PlausibilityOptions, PlausibilityMethod>;

/// The world of all clips with the same name.
class PlausibilityWorld final : public FileWorld {
 public:
  PlausibilityWorld(const PlausibilityStudy& study, const JudgedFiles& files, bool keeps_motion)
      : study_(study), files_(files), keeps_motion_(keeps_motion) {}

  CellResult Run(std::size_t method) override {
    const std::string& reference = files_.answers[method];
    if (reference.empty()) return CellResult::Ended(Status::kSkipped, "the method has no clip of this name");
    auto body = OpenBodyInPlace(reference, study_.opening);
    if (!body) return CellResult::Ended(Status::kFailed, ToString(body.error()));
    return JudgeAlone(*std::move(body), study_.options, keeps_motion_);
  }

 private:
  const PlausibilityStudy& study_;
  const JudgedFiles& files_;
  const bool keeps_motion_;
};

Result<std::unique_ptr<Task>> MakePlausibilityTask(TaskInput& input) {
  PlausibilityStudy study;
  PlausibilityConditionFields().Read(input.condition, study.options);
  ASSIGN_OR_RETURN(study.methods, ReadMethods(input, "plausibility", PlausibilityMethodFields()));
  RETURN_IF_ERROR(study.TakeFiles(input));
  return std::make_unique<FileTask<PlausibilityStudy, PlausibilityWorld>>(std::move(study));
}

}  // namespace

TaskKind MakePlausibilityTaskKind() {
  return {.name = "plausibility",
          .question = "Could a person have performed the motions in the files?",
          .default_metrics = {"faults", "floats_share", "sinks_share", "skates_share", "jumps", "pops"},
          .success = "fault_free",
          .metrics = PlausibilityMetrics(),
          .make = MakePlausibilityTask,
          .condition_keys = PlausibilityConditionFields().Describe(),
          .method_keys = PlausibilityMethodFields().Describe(),
          .has_problems = false,
          .uses_clips = false,
          .units = {SamplingUnit::kClip, SamplingUnit::kWorld},
          .find_files = FindLoneClips};
}

}  // namespace etude
