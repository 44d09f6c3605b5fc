#include <fmt/core.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "bench/model/reasons.h"
#include "bench/model/recording.h"
#include "bench/model/unit.h"
#include "bench/recordings/evaluation_extras.h"
#include "bench/tasks/base/file_task.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/evaluation/controls.h"
#include "bench/tasks/evaluation/equal_truths.h"
#include "bench/tasks/evaluation/find_files.h"
#include "bench/tasks/evaluation/match.h"
#include "bench/tasks/evaluation/options.h"
#include "bench/tasks/evaluation/run.h"
#include "engine/retargeting/body_doubts.h"
#include "engine/retargeting/joint_arrays.h"
#include "io/clips/raw_motions.h"

namespace etude {
namespace {

struct EvaluationStudy : FileStudy<EvaluationOptions, EvaluationMethod> {
  EvaluationSideData side;
  bool has_only_controls = false;
  bool are_worlds_units = false;
};

/// Returns a recording of both motions. It contains the judged joints only.
Recording RecordingOf(const MatchedMotions& matched) {
  EvaluationExtras extras;
  extras.truth.rate_hz = matched.shown ? matched.shown->rate_hz : matched.pair.rate_hz;
  extras.truth.joints = matched.joints;
  extras.truth.parents = matched.parents;
  extras.answer = extras.truth;
  extras.truth.positions = matched.shown ? matched.shown->truth.positions : matched.pair.truth.positions;
  extras.answer.positions = matched.shown ? matched.shown->answer.positions : matched.pair.found.positions;
  return {{}, WriteEvaluationExtras(extras)};
}

/// Adds doubts about features that no person's motion has. Skeletons are only searched for frozen frames:
/// UnderstandClip already refuses those whose sides are exchanged, and the joints of animators' figures may move apart.
void AddDoubts(RawMotion& motion) {
  const auto frames = RolesIn(motion);
  if (!motion.rotations.empty()) {
    motion.Doubt(DescribeFreezes(frames, motion.rate_hz));
  } else {
    for (const std::string& doubt : DoubtsOnBody(frames, motion.rate_hz)) motion.Doubt(doubt);
  }
}

/// The world of one pair of files. The truth is read when the world is made, each answer when it is judged.
class EvaluationWorld final : public FileWorld {
 public:
  EvaluationWorld(const EvaluationStudy& study, const JudgedFiles& files, bool keeps_motion)
      : study_(study), files_(files), keeps_motion_(keeps_motion), truth_(Open(study, files.truth)) {}

  std::optional<std::string> WhySkipped() const override {
    if (truth_) return std::nullopt;
    return "the truth: " + ToString(truth_.error());
  }

  CellResult Run(std::size_t method) override {
    if (const EvaluationMethod& control = study_.methods[method]; control.is_control) {
      const RawMotion noisy = Spoilt(*truth_, {.noisy_mm = study_.options.noise_mm}, files_.name);
      RawMotion answer = Spoilt(noisy, control.spoiler, files_.name + ", control");
      if (study_.has_only_controls) answer.contacts = ContactsByMotion(answer);
      HideWorst(answer, *truth_, control.spoiler.hidden_percent);
      return WithDoubts(Judged(answer).first, {}, {});
    }
    const std::string& reference = files_.answers[method];
    if (reference.empty()) return CellResult::Ended(Status::kFailed, "the method has no answer of this name");
    auto answer = OpenRawMotion(reference, study_.opening);
    if (!answer) return CellResult::Ended(Status::kFailed, ToString(answer.error()));
    AddDoubts(*answer);
    auto [result, on_pair] = Judged(*answer);
    if (result.status == Status::kOk && result.digests[0].second == result.digests[1].second) {
      on_pair.emplace_back("every position equals the truth's: is the answer a copy of the truth?");
    }
    return WithDoubts(std::move(result), answer->doubts, on_pair);
  }

 private:
  /// Ends the reason of a cell with the doubts about the truth, the answer, and the two together.
  CellResult WithDoubts(CellResult result, const std::vector<std::string>& on_answer,
                        const std::vector<std::string>& on_pair) const {
    result.reason += DoubtfulPart(kDoubtedTruth, truth_->doubts);
    result.reason += DoubtfulPart("the answer: ", on_answer);
    result.reason += DoubtfulPart("", on_pair);
    return result;
  }

  /// Reads the truth. If all methods are controls, answers are copies of the truth. Rotations that the reader
  /// computed from positions (RigClip) are then kept, and foot contacts are found from the motion.
  static Result<RawMotion> Open(const EvaluationStudy& study, const std::string& reference) {
    auto truth = OpenRawMotion(reference, study.opening, study.has_only_controls);
    if (truth && study.has_only_controls) truth->contacts = ContactsByMotion(*truth);
    if (truth && !study.has_only_controls) AddDoubts(*truth);
    return truth;
  }

  /// Returns the cell, and doubts about truth and answer together.
  std::pair<CellResult, std::vector<std::string>> Judged(const RawMotion& answer) const {
    const auto matched = Match(*truth_, answer, study_.options.joints, study_.options.lag);
    if (!matched) return {CellResult::Ended(Status::kFailed, ToString(matched.error())), {}};
    const EvaluationSideData side = study_.has_only_controls ? SideDataOf(*matched, study_.side) : study_.side;
    CellResult result = JudgeMotion(*matched, side);
    if (!files_.same_as.empty()) {
      result.reason += fmt::format(
          "; the truth is that of {}, {}", files_.same_as,
          study_.are_worlds_units ? "but each is a unit of its own (unit: world)" : "so the two are one unit");
    }
    if (keeps_motion_) result.recording = RecordingOf(*matched);
    return {std::move(result), matched->doubts};
  }

  const EvaluationStudy& study_;
  const JudgedFiles& files_;
  const bool keeps_motion_;
  const Result<RawMotion> truth_;
};

Result<std::unique_ptr<Task>> MakeEvaluationTask(TaskInput& input) {
  EvaluationStudy study;
  EvaluationConditionFields().Read(input.condition, study.options);
  ASSIGN_OR_RETURN(study.methods, ReadMethods(input, "evaluation", EvaluationMethodFields()));
  study.has_only_controls = std::ranges::all_of(study.methods, &EvaluationMethod::is_control);
  const Node* unit = input.condition.node().Find("unit");
  study.are_worlds_units = unit != nullptr && unit->scalar == SamplingUnitName(SamplingUnit::kWorld);
  RETURN_IF_ERROR(CheckFiles(input.condition.node(), study.options));
  RETURN_IF_ERROR(study.TakeFiles(input));
  if (!study.options.statistics.empty()) {
    ASSIGN_OR_RETURN(study.side.statistics,
                     ReadJointStatistics(input.texts.at("statistics"), study.options.statistics));
  }
  if (!study.options.music_beats.empty()) {
    ASSIGN_OR_RETURN(study.side.music_beats_s,
                     ReadMusicBeats(input.texts.at("music_beats"), study.options.music_beats));
  }
  return std::make_unique<FileTask<EvaluationStudy, EvaluationWorld>>(std::move(study));
}

}  // namespace

TaskKind MakeEvaluationTaskKind() {
  return {.name = "evaluation",
          .question = "How close are the motions in files to the true motions?",
          .default_metrics = {"mpjpe_unaligned_mm", "mpjpe_root_mm", "mpjpe_each_frame_scaled_mm", "accel_error_mps2",
                              "bend_error_deg"},
          .success = "seen_share",
          .metrics = EvaluationMetrics(),
          .make = MakeEvaluationTask,
          .condition_keys = EvaluationConditionFields().Describe(),
          .method_keys = EvaluationMethodFields().Describe(),
          .has_problems = false,
          .uses_clips = false,
          .units = {SamplingUnit::kClip, SamplingUnit::kWorld},
          .find_files = FindEvaluatedFiles,
          .keys_of_files = {"truth", "pairs"},
          .success_matters = kMaxShareDifference,
          .find_equal_truths = FindEqualTruths};
}

}  // namespace etude
