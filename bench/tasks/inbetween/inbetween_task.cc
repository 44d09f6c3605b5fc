#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "bench/model/recording.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/inbetween/exchange.h"
#include "bench/tasks/inbetween/options.h"
#include "bench/tasks/inbetween/score.h"
#include "bench/tasks/inbetween/windows.h"
#include "io/clips/raw_motions.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct InbetweenStudy {
  InbetweenOptions options;
  std::vector<InbetweenMethod> methods;
  std::vector<JudgedFiles> windows;
  OpenOptions opening;
  std::vector<TrainingTree> training;
  GapLibrary library;
  // The file used last. It is kept because successive windows often come from one file.
  mutable std::string reference;
  mutable Result<HiddenWindow> whole;

  const Result<HiddenWindow>& Open(const std::string& wanted) const {
    if (reference == wanted) return whole;
    reference = wanted;
    whole = OpenJudged(wanted, options, opening);
    if (!whole) return whole;
    JointTree& tree = whole->motion.tree;
    const auto known = std::ranges::find_if(training, [&](const TrainingTree& one) { return one.tree.IsLike(tree); });
    if (known == training.end()) return whole = Fail({wanted}, "no training clip has the same joints");
    if (!options.own_offsets) tree.offsets = known->tree.offsets;
    whole->deviations = known->Deviations();
    whole->file = JudgeFile(*whole);
    return whole;
  }
};

class InbetweenWorld final : public TaskWorld {
 public:
  InbetweenWorld(const InbetweenStudy& study, const JudgedFiles& window, bool keeps_motion)
      : study_(study), keeps_motion_(keeps_motion) {
    const Result<HiddenWindow>& file = study.Open(window.truth);
    const InbetweenOptions& options = study.options;
    const int first = FirstFrameOf(window.name);
    if (!file || first + options.window > static_cast<int>(file->motion.poses.size())) {
      why_ = file ? window.truth + " has become shorter" : ToString(file.error());
      return;
    }
    const auto& [tree, rate_hz, poses] = file->motion;
    hidden_ = {{tree, rate_hz, PlacedWindow(poses, first, options.window, options.past, options.facing)},
               options.past,
               options.past + options.gap - 1,
               file->roles,
               file->deviations,
               file->file};
  }

  std::optional<std::string> WhySkipped() const override { return why_; }

  CellResult Run(std::size_t method) override {
    const InbetweenMethod& one = study_.methods[method];
    const std::span poses = hidden_.motion.poses;
    const auto first = static_cast<std::size_t>(hidden_.first), after = static_cast<std::size_t>(hidden_.last) + 1;
    if (one.filler == nullptr) return ScoreFilling(hidden_, poses.subspan(first, after - first), keeps_motion_);
    const Gap gap{.tree = hidden_.motion.tree,
                  .past = poses.first(first),
                  .future = poses.subspan(after, static_cast<std::size_t>(study_.options.given)),
                  .frames = after - first,
                  .rate_hz = hidden_.motion.rate_hz,
                  .library = &study_.library,
                  .roles = hidden_.roles};
    const std::vector<TreePose> filled = one.filler->fill(gap, one.settings);
    if (filled.empty())
      return CellResult::Ended(Status::kFailed, "the training clips have no passage of this length with these joints");
    return ScoreFilling(hidden_, filled, keeps_motion_);
  }

  Result<Payload> MakeProblem() override { return GapPayload(hidden_, study_.options.given); }
  Result<Payload> MakeTruth() override { return HiddenPayload(hidden_); }
  Result<CellResult> Judge(const Json& answer) override {
    ASSIGN_OR_RETURN(const auto frames, ReadFrames(answer, hidden_));
    return ScoreFilling(hidden_, frames, keeps_motion_);
  }

 private:
  const InbetweenStudy& study_;
  const bool keeps_motion_;
  std::optional<std::string> why_;
  HiddenWindow hidden_;
};

class InbetweenTask final : public Task {
 public:
  explicit InbetweenTask(InbetweenStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool keeps_motion) const override {
    return std::make_unique<InbetweenWorld>(study_, WindowOf(key), keeps_motion);
  }

  /// Returns the name of the window's file or, with the key `people`, the person in that name.
  std::vector<std::string> ClipsOf(const WorldKey& key) const override { return {WindowOf(key).unit}; }

  Result<Payload> Setting() const override {
    return PayloadOf({{"past", study_.options.past}, {"gap", study_.options.gap}, {"given", study_.options.given}});
  }

 private:
  const JudgedFiles& WindowOf(const WorldKey& key) const { return study_.windows[static_cast<std::size_t>(key.trial)]; }

  const InbetweenStudy study_;
};

Result<std::unique_ptr<Task>> MakeInbetweenTask(TaskInput& input) {
  InbetweenStudy study;
  InbetweenConditionFields().Read(input.condition, study.options);
  ASSIGN_OR_RETURN(study.methods, ReadMethods(input, "inbetween", InbetweenMethodFields()));
  study.windows.assign(input.files.begin(), input.files.end());
  if (input.opening != nullptr) study.opening = *input.opening;
  if (!study.windows.empty()) {
    const bool needs_library = std::ranges::any_of(study.methods, [](const InbetweenMethod& method) {
      return method.filler != nullptr && method.filler->uses_library;
    });
    ASSIGN_OR_RETURN(study.training, Train(study.options, study.opening, needs_library ? &study.library : nullptr));
  }
  return std::make_unique<InbetweenTask>(std::move(study));
}

}  // namespace

TaskKind MakeInbetweenTaskKind() {
  return {.name = "inbetween",
          .question = "How close to the truth are the frames that a method fills into a gap of a motion?",
          .default_metrics = {"l2p@lafan1", "l2q@lafan1", "npss@lafan1", "supported_share", "foot_slide_cmps",
                              "jitter@wham"},
          .success = "supported_share",
          .metrics = InbetweenMetrics(),
          .make = MakeInbetweenTask,
          .condition_keys = InbetweenConditionFields().Describe(),
          .method_keys = InbetweenMethodFields().Describe(),
          .uses_clips = false,
          .units = {SamplingUnit::kClip, SamplingUnit::kWorld},
          .find_files = FindWindows,
          .keys_of_files = {"truth"}};
}

}  // namespace etude
