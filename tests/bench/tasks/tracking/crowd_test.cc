#include "bench/tasks/tracking/crowd.h"

#include <gtest/gtest.h>

#include "bench/tasks/tracking/run.h"
#include "tests/support/results.h"

namespace etude {
namespace {

constexpr CrowdOptions kFew{.characters = 23, .frames = 12};

TEST(Crowd, FollowsEverybodyToTheLastBitAsTaskTrackingFollowsEachAlone) {
  ASSERT_OK(worlds, MakeCrowd(kFew));
  std::vector<TrackingAnswer> alone;
  TrackingMethod method{.name = "default", .options = {}};
  method.options.max_iterations = 20;
  for (const TrackingWorld& world : *worlds) alone.push_back(Follow(world, method).value());
  Crowd crowd(*worlds);
  int met = 0, compared = 0;
  for (std::size_t frame = 0; frame < kFew.frames; ++frame) {
    const Crowd::Followed followed = crowd.FollowNext(method.options, Precision::kDouble);
    met += followed.met;
    int steps = 0;
    for (std::size_t i = 0; i < worlds->size(); ++i, ++compared) {
      EXPECT_EQ(crowd.StateOf(i).angles, alone[i].angles[frame]) << "frame " << frame << " of " << i;
      steps += (*alone[i].iterations)[frame];
    }
    EXPECT_EQ(followed.steps, steps);
  }
  EXPECT_EQ(compared, kFew.characters * kFew.frames);
  EXPECT_GT(met, compared / 2);
}

TEST(Crowd, GoesWhereItsWorldsGoWithinTheLimits) {
  ASSERT_OK(worlds, MakeCrowd(kFew));
  for (const Precision precision : {Precision::kDouble, Precision::kFloat}) {
    Crowd crowd(*worlds);
    for (int frame = 0; frame < kFew.frames; ++frame) {
      const int met = crowd.FollowNext({}, precision).met;
      int found = 0;
      for (std::size_t i = 0; i < worlds->size(); ++i) {
        const TrackingWorld& world = (*worlds)[i];
        const TreeState state = crowd.StateOf(i);
        for (std::size_t d = 0; d < state.angles.size(); ++d) {
          EXPECT_GE(state.angles[d], world.tree.limits[d].lower);
          EXPECT_LE(state.angles[d], world.tree.limits[d].upper);
        }
        double farthest = 0;
        const TreeFrames frames = ComputeFrames(world.tree, state);
        for (std::size_t e = 0; e < frames.effectors.size(); ++e) {
          const glm::dvec3& wanted = world.targets[static_cast<std::size_t>(frame)][e].position;
          farthest = std::max(farthest, glm::distance(frames.effectors[e].position, wanted));
        }
        const bool is_there = farthest < 0.001;
        EXPECT_TRUE(is_there || !crowd.HasMet(i)) << "frame " << frame << " of " << i;
        found += crowd.HasMet(i);
      }
      EXPECT_EQ(found, met);
      EXPECT_EQ(met, kFew.characters) << "every target is met by a pose of this body";
    }
  }
}

}  // namespace
}  // namespace etude
