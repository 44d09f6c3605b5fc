#include "bench/tasks/coach/train_coached.h"

#include <array>
#include <utility>
#include <vector>

#include "bench/tasks/coach/learner_player.h"
#include "bench/tasks/coach/operating_point.h"
#include "bench/tasks/coach/run.h"
#include "bench/tasks/detection/train_recogniser.h"
#include "engine/recognition/measuring_recogniser.h"

namespace etude {
namespace {

/// A song, and a coach who dances it without interrupting the learner.
struct Lesson {
  CoachStage stage;
  ReadyCoach coach;
};

Result<std::unique_ptr<Lesson>> MakeLesson(const std::string& song) {
  auto lesson = std::make_unique<Lesson>();
  ASSIGN_OR_RETURN(lesson->stage, SetCoachStage(song));
  ASSIGN_OR_RETURN(lesson->coach, MakeWatching(lesson->stage));
  return lesson;
}

/// Draws a person, a sensor and its noise.
CoachCondition DrawCondition(const WorldKey& key) {
  RandomStream dice(key, "condition");
  constexpr std::array<double, 4> kNoises = {0.5, 1, 1, 2};
  CoachCondition condition;
  condition.sight.noise = kNoises[dice.IndexBelow(kNoises.size())];
  if (dice.Chance(0.5)) condition.sight.sensor = SensorV1();
  condition.sight.session.people = People::kMixed;
  condition.learner.skill = dice.Uniform(0.1, 0.8);
  // Give half of the sessions full severity. Faults of full severity would otherwise be rare, and the model must learn
  // to detect them.
  if (dice.Chance(0.5)) condition.learner.severity = 1;
  return condition;
}

/// Adds a bag of candidate performances for each window whose performance is right or wrong, not grey. A bag keeps only
/// the candidates nearest to the move (KeepNearest), because the farther ones cannot influence the fit.
void AddSession(const Lesson& lesson, const SessionLog& log, Weighting weighting, std::vector<LabelledBag>& bags) {
  std::vector<PerformanceMeasures> measured;
  const auto recogniser =
      MakeMeasuringRecogniser(lesson.stage.taught, {.weighting = weighting},
                              [&](PerformanceOrigin occasion, std::size_t, const PerformanceMeasures& measures) {
                                if (occasion == PerformanceOrigin::kAsked) measured.push_back(measures);
                                return 0.0;
                              });
  FollowPerformances(log, *recogniser, {}, [&](const LoggedPerformance& performance, double) {
    std::vector<PerformanceMeasures> own = std::exchange(measured, {});
    if (performance.judged.truth == PerformanceTruth::kGrey || own.empty()) return;
    KeepNearest(own);
    bags.push_back({performance.judged.truth == PerformanceTruth::kRight, std::move(own)});
  });
}

}  // namespace

Result<LearntModel> TrainCoached(std::span<const std::string> songs, const CoachedTraining& training) {
  std::vector<std::unique_ptr<Lesson>> lessons;
  for (const std::string& song : songs) {
    ASSIGN_OR_RETURN(auto lesson, MakeLesson(song));
    lessons.push_back(std::move(lesson));
  }
  std::vector<LabelledBag> bags;
  for (int session = 0; session < training.sessions; ++session) {
    const WorldKey key{.suite_seed = training.seed, .scenario = "coached-training", .trial = session};
    const auto index = static_cast<std::size_t>(session);
    const Lesson& lesson = *lessons[index % lessons.size()];
    const CoachCondition condition = DrawCondition(key);
    const CoachWorld world = MakeCoachWorld(condition, key);
    ASSIGN_OR_RETURN(const SessionLog log, RunMethod(lesson.coach, condition, lesson.stage, world, nullptr));
    const bool weighs = index / lessons.size() % 2 == 1;
    AddSession(lesson, log, weighs ? Weighting::kAdaptive : Weighting::kFixed, bags);
    if (training.progress) training.progress(index + 1, training.sessions);
  }
  return LearntModel{.asked = FitBoostedTrees(bags, training.boosting), .spotted = {}};
}

}  // namespace etude
