#include "bench/tasks/coach/learner_player.h"

#include <algorithm>

#include "sim/choreography/slow_demonstration.h"
#include "sim/skeleton_sensor/skeleton_sensor.h"

namespace etude {
namespace {

/// The learner's reaction time in frames: from the content of the screen that the learner sees to the requested pose.
constexpr double kFramesAhead = static_cast<double>(SkeletonSensor::kAhead) + 1;

PerformanceTruth TruthOf(Truth truth) {
  if (truth == Truth::kGrey) return PerformanceTruth::kGrey;
  return truth == Truth::kRight ? PerformanceTruth::kRight : PerformanceTruth::kWrong;
}

}  // namespace

LearnerPlayer::LearnerPlayer(const CoachWorld& world, const CoachStage& stage)
    : stage_(stage),
      learner_(world.key, world.person, stage.moves, *stage.showable, world.learner),
      latest_(stage.dance().repetitions.size(), -1) {}

BodyPose LearnerPlayer::Next(const CoachOutput& shown) { return learner_.Step(SeenOf(shown)); }

Shown LearnerPlayer::SeenOf(const CoachOutput& shown) {
  Shown seen;
  SeeRecords(shown, seen);
  const bool dances = shown.mode == CoachMode::kDance && shown.clip == "dance" && !shown.in_transition;
  if (dances) {
    SeeDance(shown, seen);
    return seen;
  }
  last_frame_.reset();
  danced_ = -1;
  if (shown.mode == CoachMode::kCorrect) {
    seen.act = Shown::Act::kCorrect;
    seen.move = about_;
  } else if (shown.mode == CoachMode::kDemonstrate) {
    seen.act = Shown::Act::kDemonstrate;
    seen.move = MoveShownSlowly(shown.clip);
  }
  return seen;
}

/// Sets `seen` to the move and the beat that the dance will reach in kFramesAhead frames if it keeps its present rate.
void LearnerPlayer::SeeDance(const CoachOutput& shown, Shown& seen) {
  const double rate = last_frame_ ? std::clamp(shown.clip_frame - *last_frame_, 0.0, 2.0) : 1;
  last_frame_ = shown.clip_frame;
  const double frame = shown.clip_frame + kFramesAhead * rate;
  const int index = stage_.library->RepetitionAt(frame);
  if (index < 0) return;
  const Repetition& repetition = stage_.dance().repetitions[static_cast<std::size_t>(index)];
  if (frame >= static_cast<double>(repetition.end)) {
    danced_ = -1;
    return;
  }
  if (index != danced_) {
    danced_ = index;
    latest_[static_cast<std::size_t>(index)] = performances_++;
  }
  const double first = static_cast<double>(repetition.first), length = static_cast<double>(repetition.end) - first;
  seen.act = Shown::Act::kDance;
  seen.move = repetition.move;
  seen.repetition = latest_[static_cast<std::size_t>(index)];
  seen.beat = (frame - first) / length * stage_.moves[static_cast<std::size_t>(repetition.move)].beats;
}

void LearnerPlayer::SeeRecords(const CoachOutput& shown, Shown& seen) {
  for (const CoachRecord& record : shown.records) {
    if (record.event == CoachEvent::kCorrects || record.event == CoachEvent::kShows) about_ = record.move;
    seen.praises |= record.event == CoachEvent::kPraises;
  }
}

int LearnerPlayer::MoveShownSlowly(std::string_view clip) const {
  if (!clip.starts_with(kSlowDemonstrationPrefix)) return about_;
  const std::string_view name = clip.substr(kSlowDemonstrationPrefix.size());
  const auto found = std::ranges::find(stage_.moves, name, &Move::name);
  return found == stage_.moves.end() ? about_ : static_cast<int>(found - stage_.moves.begin());
}

std::optional<PlayedPerformance> LearnerPlayer::PerformanceOf(int repetition) const {
  const int latest = latest_[static_cast<std::size_t>(repetition)];
  if (latest < 0) return std::nullopt;
  const auto performances = learner_.performances();
  const auto found = std::find_if(performances.rbegin(), performances.rend(),
                                  [&](const LearnerPerformance& danced) { return danced.repetition == latest; });
  if (found == performances.rend()) return std::nullopt;
  return PlayedPerformance{TruthOf(found->event.truth), FaultNames(found->event.faults)};
}

std::vector<double> LearnerPlayer::TakeTest(int performances_later) {
  std::vector<double> chances;
  for (std::size_t move = 0; move < stage_.moves.size(); ++move) {
    chances.push_back(learner_.RetainedChanceOfRight(move, performances_later));
  }
  return chances;
}

}  // namespace etude
