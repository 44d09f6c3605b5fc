#include "bench/tasks/transition/transition_task.h"

#include <fmt/format.h>

#include "bench/tasks/transition/adaptive_weights.h"
#include "bench/tasks/transition/options.h"
#include "bench/tasks/transition/scoring.h"
#include "bench/tasks/transition/stage.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

/// One trial's truth: which clip plays, which is asked for, and when.
struct TransitionWorld {
  int from = 0;
  int to = 0;
  int request_frame = 0;
};

std::string GradesDigest(const TaggedClip& from, const TaggedClip& to) {
  Digest digest;
  for (const TaggedClip* clip : {&from, &to}) {
    for (const Grades& grades : clip->grades) digest.Add(std::span<const double>(grades));
  }
  return digest.Hex();
}

std::string BridgeFramesDigest(const TaggedClip& from, const TaggedClip& to) {
  Digest digest;
  for (const TaggedClip* clip : {&from, &to}) {
    for (int frame : clip->bridge_frames) digest.Add(std::int64_t{frame});
  }
  return digest.Hex();
}

std::string SwitchesDigest(const Transition& plan) {
  Digest digest;
  for (const Switch& change : plan.switches) {
    digest.Add(std::int64_t{change.from_clip}).Add(std::int64_t{change.from_frame});
    digest.Add(std::int64_t{change.to_clip}).Add(std::int64_t{change.to_frame}).Add(change.distance.value);
  }
  return digest.Hex();
}

std::string MotionDigest(const BodyMotion& motion) {
  Digest digest;
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) digest.Add(joint.x).Add(joint.y).Add(joint.z);
  }
  return digest.Hex();
}

class TransitionTask final : public Task {
 public:
  TransitionTask(std::vector<TransitionMethod> methods, Stage stage, Stage training, bool wants_recordings)
      : methods_(std::move(methods)),
        stage_(std::move(stage)),
        training_(std::move(training)),
        adaptive_(training_),
        wants_recordings_(wants_recordings) {}

  std::vector<CellResult> RunWorld(const WorldKey& key) const override {
    const Result<TransitionWorld> world = MakeWorld(key);
    std::vector<CellResult> results;
    for (const TransitionMethod& method : methods_) {
      results.push_back(world ? RunMethod(method, *world) : Skip(world.error().message));
    }
    return results;
  }

  std::string ClipOf(const WorldKey& key) const override {
    return stage_.names.empty() ? "" : stage_.names[FromClip(key)];
  }

 private:
  int FromClip(const WorldKey& key) const { return key.trial % static_cast<int>(stage_.names.size()); }

  bool IsLongEnough(int clip) const { return stage_.tagged[clip].FrameCount() >= kShortestClip; }

  /// The error is the reason to skip this world.
  Result<TransitionWorld> MakeWorld(const WorldKey& key) const {
    const int count = static_cast<int>(stage_.names.size());
    if (count < 2) return Fail({}, "a switch needs two clips; this library has {}", count);
    TransitionWorld world{.from = FromClip(key)};
    if (!IsLongEnough(world.from)) {
      return Fail({}, "clip {} has {} frames; a switch is judged over at least {}", stage_.names[world.from],
                  stage_.tagged[world.from].FrameCount(), kShortestClip);
    }
    std::vector<int> others;
    for (int clip = 0; clip < count; ++clip) {
      if (clip != world.from && IsLongEnough(clip)) others.push_back(clip);
    }
    if (others.empty()) return Fail({}, "no other clip of this library has {} frames", kShortestClip);
    world.to = others[RandomStream(key, "to-clip").IndexBelow(others.size())];
    // Late enough for a whole window before the seam, early enough to be before the clip's end.
    const int last = stage_.tagged[world.from].FrameCount() - 2;
    RandomStream dice(key, "request-time");
    world.request_frame = kEarliestRequest + static_cast<int>(dice.IndexBelow(last - kEarliestRequest + 1));
    return world;
  }

  SwitchOutcome Switch(const TransitionMethod& method, const TransitionWorld& world) const {
    SwitchOutcome outcome{.method = &method, .weights = method.rules.weights, .plan = {}, .splice = {}};
    if (method.adaptive_weights) {
      outcome.weights = adaptive_.Without(stage_.identities[world.from], stage_.identities[world.to]).weights;
    }
    SwitchRules rules = method.rules;
    rules.weights = outcome.weights;
    outcome.plan = PlanTransition(stage_.tagged, world.from, world.request_frame, world.to, method.choice, rules);
    if (!outcome.plan.switches.empty()) {
      outcome.splice = SpliceClips(stage_.motions, outcome.plan.switches, method.join);
    }
    return outcome;
  }

  CellResult RunMethod(const TransitionMethod& method, const TransitionWorld& world) const {
    const SwitchOutcome outcome = Switch(method, world);
    const TaggedClip &from = stage_.tagged[world.from], &to = stage_.tagged[world.to];
    CellResult result;
    result.digests = {{"features", GradesDigest(from, to)},
                      {"bridge_frames", BridgeFramesDigest(from, to)},
                      {"weights", Digest().Add(std::span<const double>(outcome.weights)).Hex()},
                      {"switches", SwitchesDigest(outcome.plan)},
                      {"motion", MotionDigest(outcome.splice.motion)}};
    if (outcome.plan.branch == Branch::kNone) {
      result.status = Status::kUnsolved;
      result.reason = WhyNoWay(method, world, outcome.plan);
      MissAllMetrics("no way was found", result);
      return result;
    }
    result.status = Status::kOk;
    result.reason.clear();
    ScoreSwitch(outcome, stage_, result);
    result.series.push_back(SeamSeries(outcome));
    if (wants_recordings_) result.recording = RecordSwitch(outcome, stage_);
    return result;
  }

  std::string WhyNoWay(const TransitionMethod& method, const TransitionWorld& world, const Transition& plan) const {
    const std::string when = fmt::format("within {:g} s of the request", method.rules.max_wait_s);
    if (plan.pairs_seen == 0) return fmt::format("{} has no bridge frame {}", stage_.names[world.from], when);
    return fmt::format(
        "no bridge frame of {} {} matches one of {}, directly or through a third clip ({} pairs compared)",
        stage_.names[world.from], when, stage_.names[world.to], plan.pairs_seen);
  }

  static CellResult Skip(const std::string& reason) {
    CellResult result;
    result.status = Status::kSkipped;
    result.reason = reason;
    MissAllMetrics(reason, result);
    return result;
  }

  static constexpr int kEarliestRequest = 6;

  std::vector<TransitionMethod> methods_;
  Stage stage_;
  Stage training_;
  mutable AdaptiveWeights adaptive_;  // remembers fits; what it answers depends on the question only
  bool wants_recordings_;
};

Result<std::unique_ptr<Task>> MakeTransitionTask(TaskInput& input) {
  auto methods = ReadTransitionMethods(input.condition, input.methods);
  if (!methods) return tl::unexpected(methods.error());
  Stage stage = SetStage(input.clips);
  auto training = SetTrainingStage(stage);
  if (!training) return tl::unexpected(training.error());
  return std::make_unique<TransitionTask>(*std::move(methods), std::move(stage), *std::move(training),
                                          input.wants_recordings);
}

}  // namespace

TaskKind MakeTransitionTaskKind() {
  return {.name = "transition",
          .question = "How smoothly does a dancer get from one clip into another when called?",
          .default_metrics = {"jump_cm", "natural_share", "pose_gap_cm", "false_smooth", "foot_slide_cmps", "wait_s"},
          .make = MakeTransitionTask,
          .method_keys = TransitionMethodKeys()};
}

}  // namespace etude
