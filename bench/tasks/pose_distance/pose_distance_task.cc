#include <fmt/format.h>

#include "bench/tasks/base/fuzzy_key.h"
#include "bench/tasks/base/read_methods.h"
#include "bench/tasks/base/task_kinds.h"
#include "bench/tasks/pose_distance/exchange.h"
#include "bench/tasks/pose_distance/options.h"
#include "bench/tasks/pose_distance/run.h"
#include "bench/tasks/pose_distance/world.h"
#include "bench/training/training_pairs.h"

namespace etude {
namespace {

/// The data that all worlds of one condition share.
struct PairStudy {
  PairOptions options;
  std::vector<PoseDistanceMethod> methods;
  DancedClips clips;
  FuzzySystem fuzzy;
  mutable LearntWeights learnt;  ///< fits weights and caches them; no result depends on the state of the cache
};

class PoseDistanceWorld final : public TaskWorld {
 public:
  PoseDistanceWorld(const PairStudy& study, PairWorld world) : study_(study), world_(std::move(world)) {}

  CellResult Run(std::size_t index) override {
    const PoseDistanceMethod& method = study_.methods[index];
    const FeatureWeights& weights = study_.learnt.For(method.weights, world_.clip_a, world_.clip_b);
    return ScorePairs(world_, ComputePairVerdict(world_, method, study_.fuzzy.memberships, weights), &method.distance);
  }

  Result<Payload> MakeProblem() override { return PairsPayload(world_); }
  Result<Payload> MakeTruth() override { return GapsPayload(world_); }

  Result<CellResult> Judge(const Json& answer) override {
    ASSIGN_OR_RETURN(const auto verdict, ReadPairAnswer(answer, world_));
    return ScorePairs(world_, verdict, nullptr);
  }

 private:
  const PairStudy& study_;
  const PairWorld world_;
};

class PoseDistanceTask final : public Task {
 public:
  explicit PoseDistanceTask(PairStudy study) : study_(std::move(study)) {}

  std::unique_ptr<TaskWorld> MakeWorld(const WorldKey& key, bool /*keeps_motion*/) const override {
    return std::make_unique<PoseDistanceWorld>(study_, WorldOf(key));
  }

  /// Returns the name of the blind spot or, for frames, the clips of the pairs' first and second poses.
  std::vector<std::string> ClipsOf(const WorldKey& key) const override {
    if (study_.options.source == PairSource::kBlindSpots) return {ShowBlindSpot(key.trial).name};
    const auto [first, second] = DrawClips(study_.clips, key);
    return {study_.clips.names[first], study_.clips.names[second]};
  }

  Result<Payload> Setting() const override { return BodyPayload(); }

 private:
  PairWorld WorldOf(const WorldKey& key) const {
    if (study_.options.source == PairSource::kBlindSpots) return ShowBlindSpot(key.trial);
    return DrawFramePairs(study_.clips, study_.options.pairs_per_world, key);
  }

  const PairStudy study_;
};

Result<std::unique_ptr<Task>> MakePoseDistanceTask(TaskInput& input) {
  PairOptions options;
  PoseDistanceConditionFields().Read(input.condition, options);
  ASSIGN_OR_RETURN(auto methods, ReadMethods(input, "pose-distance", PoseDistanceMethodFields()));
  DancedClips clips = DanceClips(input.clips);
  if (options.source == PairSource::kFrames && !HasTwoSources(clips)) {
    return Fail(input.condition.node().place,
                "in task pose-distance, 'pairs: frames' needs 'clips' with at least two different clips, such as "
                "['builtin:*']");
  }
  ASSIGN_OR_RETURN(const auto fuzzy, FuzzySystemOf(input));
  ASSIGN_OR_RETURN(auto training, GatherTrainingClips(clips.motions, clips.identities, clips.proportions));
  return std::make_unique<PoseDistanceTask>(
      PairStudy{options, std::move(methods), std::move(clips), fuzzy, LearntWeights(std::move(training), fuzzy)});
}

}  // namespace

TaskKind MakePoseDistanceTaskKind() {
  return {.name = "pose-distance",
          .question = "How reliably does a distance show that two poses look alike?",
          .default_metrics = {"called_alike", "fuzzy_distance", "joint_distance_cm", "pose_gap_cm", "close_auc",
                              "close_f1"},
          .success = "close_f1",
          .metrics = PoseDistanceMetrics(),
          .make = MakePoseDistanceTask,
          .condition_keys = PoseDistanceConditionFields().Describe(),
          .method_keys = PoseDistanceMethodFields().Describe(),
          .units = {SamplingUnit::kClipPair, SamplingUnit::kClip, SamplingUnit::kLibrary, SamplingUnit::kWorld}};
}

}  // namespace etude
