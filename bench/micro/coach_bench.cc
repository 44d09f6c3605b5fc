// Times one frame of the coach's loop, as a whole and by stage: the learner, the sensor, filter and features, each
// recogniser, and the coach's own step.
//   build/release/bench/micro/coach_bench --benchmark_repetitions=5 --benchmark_report_aggregates_only=true
#include <benchmark/benchmark.h>

#include <list>
#include <string>
#include <vector>

#include "bench/tasks/coach/learner_player.h"
#include "bench/tasks/coach/run.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"

namespace etude {
namespace {

/// The log of a session of one minute with a coach that corrects after the first mistake.
struct Lesson {
  CoachCondition condition;
  CoachStage stage = *SetCoachStage("groove");
  CoachWorld world;
  SessionLog log;

  Lesson() {
    condition.session_s = 60;
    condition.sight.session.people = People::kAdult;
    world = MakeCoachWorld(condition, {1, "coach-bench", 0});
    log = *RunMethod(ReadyWith("dtw"), condition, stage, world, nullptr);
  }

  const ReadyCoach& ReadyWith(const std::string& recogniser) {
    for (const ReadyCoach& ready : ready_) {
      if (ready.method.name == recogniser) return ready;
    }
    CoachMethod method;
    method.name = recogniser;
    method.sight.recogniser.kind = FindRecogniser(recogniser);
    ready_.push_back(std::move(MakeReady({method}, stage)->front()));
    return ready_.back();
  }

 private:
  std::list<ReadyCoach> ready_;
};

Lesson& TheLesson() {
  static Lesson lesson;
  return lesson;
}

void CountFrames(benchmark::State& state, int frames) {
  state.counters["a frame"] = benchmark::Counter(static_cast<double>(state.iterations()) * frames,
                                                 benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void WholeSession(benchmark::State& state, const std::string& recogniser) {
  Lesson& lesson = TheLesson();
  const ReadyCoach& ready = lesson.ReadyWith(recogniser);
  for (auto _ : state) {
    benchmark::DoNotOptimize(RunMethod(ready, lesson.condition, lesson.stage, lesson.world, nullptr)->Frames());
  }
  CountFrames(state, lesson.log.Frames());
}

/// Times the learner alone. The learner sees a coach that never interrupts.
void LearnerAlone(benchmark::State& state) {
  Lesson& lesson = TheLesson();
  const ReadyCoach& ready = lesson.ReadyWith("dtw");
  const Coach coach(*ready.transitions, {}, {FindPolicy("never"), {}});
  std::vector<CoachOutput> shown;
  CoachState at = coach.BeginDancing();
  const FeatureFrame features{};
  for (int frame = 0; frame < lesson.log.Frames(); ++frame) {
    CoachStep step = coach.Step(std::move(at), {.seen = {SensedFrame{}, features}});
    at = std::move(step.state);
    shown.push_back(std::move(step.output));
  }
  for (auto _ : state) {
    LearnerPlayer player(lesson.world, lesson.stage);
    for (const CoachOutput& output : shown) benchmark::DoNotOptimize(player.Next(output).joints.front());
  }
  CountFrames(state, lesson.log.Frames());
}

void Sensor(benchmark::State& state) {
  const Lesson& lesson = TheLesson();
  for (auto _ : state) {
    SkeletonSensor sensor(lesson.world.sensor, lesson.world.occluders, lesson.world.errors, kJudgedRateHz,
                          lesson.world.key);
    for (const BodyPose& pose : lesson.log.learner.poses) benchmark::DoNotOptimize(sensor.Update(pose).has_value());
  }
  CountFrames(state, lesson.log.Frames());
}

void Eyes(benchmark::State& state) {
  const Lesson& lesson = TheLesson();
  for (auto _ : state) {
    LiveSight sight({}, kJudgedRateHz);
    for (const SensedFrame& frame : lesson.log.sensed.frames) {
      benchmark::DoNotOptimize(sight.Update(frame).features.body_seen);
    }
  }
  CountFrames(state, lesson.log.Frames());
}

void Recognising(benchmark::State& state, const std::string& recogniser) {
  Lesson& lesson = TheLesson();
  const SeenStream seen = SeeStream(lesson.log.sensed, {});
  for (auto _ : state) {
    const auto follower = lesson.ReadyWith(recogniser).recogniser->Follow(kJudgedRateHz);
    auto asked = lesson.log.performances.begin();
    for (int frame = 0; frame < lesson.log.Frames(); ++frame) {
      if (asked != lesson.log.performances.end() && frame == asked->judged.begin_frame) {
        follower->Ask(static_cast<std::size_t>((asked++)->move));
      }
      benchmark::DoNotOptimize(follower->Update(seen[static_cast<std::size_t>(frame)]).asked);
    }
  }
  CountFrames(state, lesson.log.Frames());
}

void CoachStepping(benchmark::State& state) {
  Lesson& lesson = TheLesson();
  const Coach& coach = *lesson.ReadyWith("dtw").coach;
  const SeenStream seen = SeeStream(lesson.log.sensed, {});
  for (auto _ : state) {
    CoachState at = coach.BeginDancing();
    for (int frame = 0; frame < lesson.log.Frames(); ++frame) {
      CoachStep step = coach.Step(std::move(at), {.seen = seen[static_cast<std::size_t>(frame)]});
      at = std::move(step.state);
    }
    benchmark::DoNotOptimize(at.frame);
  }
  CountFrames(state, lesson.log.Frames());
}

void Scoring(benchmark::State& state) {
  const Lesson& lesson = TheLesson();
  for (auto _ : state) {
    CellResult result = CellResult::Ended(Status::kOk, "");
    ScoreCoaching(lesson.world, lesson.stage, lesson.log, result);
    benchmark::DoNotOptimize(result.metrics.size());
  }
  CountFrames(state, lesson.log.Frames());
}

[[maybe_unused]] const bool kRegistered = [] {
  const auto add = [](const std::string& name, auto... run) {
    benchmark::RegisterBenchmark(name.c_str(), run...)->Unit(benchmark::kMillisecond);
  };
  for (const RecogniserKind& kind : AllRecognisers()) add("session/" + kind.name, WholeSession, kind.name);
  add("learner", LearnerAlone);
  add("sensor", Sensor);
  add("eyes", Eyes);
  for (const RecogniserKind& kind : AllRecognisers()) add("recognise/" + kind.name, Recognising, kind.name);
  add("coach", CoachStepping);
  add("score", Scoring);
  return true;
}();

}  // namespace
}  // namespace etude
