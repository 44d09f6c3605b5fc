#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/plausibility/find_clips.h"
#include "bench/tasks/plausibility/judge.h"
#include "bench/tasks/plausibility/options.h"
#include "engine/base/names.h"
#include "io/clips/body_in_place.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct PlausibilityStudy {
  PlausibilityOptions options;
  std::vector<PlausibilityMethod> methods;
  std::vector<JudgedFiles> files;
  OpenOptions opening;
};

/// The clips of one name.
class PlausibilityWorld final : public TaskWorld {
 public:
  PlausibilityWorld(const PlausibilityStudy& study, const JudgedFiles& files) : study_(study), files_(files) {}

  CellResult Run(std::size_t method) override {
    const std::string& reference = files_.answers[method];
    if (reference.empty()) return CellResult::Ended(Status::kSkipped, "the method has no clip of this name");
    const auto body = OpenBodyInPlace(reference, study_.opening);
    if (!body) return CellResult::Ended(Status::kFailed, ToString(body.error()));
    return JudgeAlone(*body, study_.options);
  }

  Result<Payload> MakeProblem() override { return Refused(); }
  Result<Payload> MakeTruth() override { return Refused(); }
  Result<CellResult> Judge(const Json&) override { return Refused(); }

 private:
  static tl::unexpected<Error> Refused() { return Fail({}, "task plausibility judges files and asks no program"); }

  const PlausibilityStudy& study_;
  const JudgedFiles& files_;
};

class PlausibilityTask final : public Task {
 public:
  explicit PlausibilityTask(PlausibilityStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool /*keeps_motion*/) const override {
    return std::make_unique<PlausibilityWorld>(study_, study_.files[static_cast<std::size_t>(key.trial)]);
  }

  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    return {study_.files[static_cast<std::size_t>(key.trial)].name};
  }

  Result<Payload> Setting() const override { return Fail({}, "task plausibility judges files and asks no program"); }

 private:
  const PlausibilityStudy study_;
};

Result<std::unique_ptr<Task>> MakePlausibilityTask(TaskInput& input) {
  PlausibilityStudy study;
  PlausibilityConditionFields().Read(input.condition, study.options);
  ASSIGN_OR_RETURN(study.methods, ReadMethods(input, "plausibility", PlausibilityMethodFields()));
  study.files.assign(input.files.begin(), input.files.end());
  if (input.opening != nullptr) study.opening = *input.opening;
  for (const JudgedFiles& files : study.files) {
    if (files.answers.size() != study.methods.size()) {
      return Fail(input.condition.node().place, "{} has {} answers; the scenario has {} methods", Quote(files.name),
                  files.answers.size(), study.methods.size());
    }
  }
  return std::make_unique<PlausibilityTask>(std::move(study));
}

}  // namespace

TaskKind MakePlausibilityTaskKind() {
  return {.name = "plausibility",
          .question = "Could a person have moved as the motions of files do?",
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
