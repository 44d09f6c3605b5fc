// The library returns what the engine returns. Where the engine only asserts, the library refuses with a reason.
#include <etude/capture.h>
#include <etude/fuzzy.h>
#include <etude/recognition.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "tests/support/results.h"

namespace etude::engine {
namespace {

using ::testing::HasSubstr;

template <typename Act>
std::string Refusal(const Act& act) {
  try {
    act();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(ApiFuzzy, RefusesClipsThatAreNone) {
  EXPECT_THAT(Refusal([] { Bridges({}); }), HasSubstr("no clips"));
  const Motion empty;
  EXPECT_THAT(Refusal([&] { Bridges(std::span(&empty, 1)); }), HasSubstr("clip 0: no frames"));
  EXPECT_THAT(Refusal([] { ReadMotion("HIERARCHY\nROOTS", "mine.bvh"); }), HasSubstr("mine.bvh:2:"));
}

TEST(ApiCameras, RefusesWhatDeterminesNoCamera) {
  const std::vector<PointPair> few(5);
  EXPECT_THAT(Refusal([&] { Calibrate(few, 640, 480); }), Not(::testing::IsEmpty()));
  EXPECT_THAT(Refusal([&] { Calibrate(few, 0, 480); }), HasSubstr("allowed"));
  const std::vector<NamedCamera> two(2);
  EXPECT_THAT(Refusal([&] { Triangulate(two, {}); }), HasSubstr("0 entries for 2 cameras"));
  const std::vector<SeenPeople> none(2);
  EXPECT_THAT(Refusal([&] { Capture(two, none); }), HasSubstr("0 frames"));
}

/// Returns a standing body whose right arm swings; joints have no names.
Motion Swinging(double turns) {
  Motion motion;
  for (int frame = 0; frame < 40; ++frame) {
    Pose& pose = motion.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) pose.joints[i] = {0.1 * static_cast<double>(i % 5), 0.1 * i, 0.02 * i};
    const double angle = 6.283185307179586 * turns * frame / 40;
    pose[Role::kRightHand] += glm::dvec3(0, 0.3 * std::sin(angle), 0.3 * std::cos(angle));
  }
  return motion;
}

TEST(ApiRecognition, FollowsAsTheEngineDoesToTheLastBit) {
  const std::vector<TaughtMove> moves = {{.name = "once", .examples = {StreamOf(Swinging(1))}},
                                         {.name = "thrice", .examples = {StreamOf(Swinging(3))}}};
  for (const std::string kind : {"whole-body", "dtw", "nearest"}) {
    RecogniserStream stream = Recogniser(moves, {.kind = kind}).Follow();
    stream.Ask(1);
    const SkeletonStream& shown = moves[1].examples.front();
    ASSERT_OK(recogniser, MakeRecogniser({.kind = FindRecogniser(kind)}, moves));
    FilterOptions filter;
    filter.kind = FilterKind::kHolt;
    const std::vector<AskedMove> asked = {{1, {0, 40}}};
    ASSERT_OK(trace, FollowStream(**recogniser, 2, SeeStream(shown, filter), asked));
    for (int frame = 0; frame < 40; ++frame) {
      const Evidence evidence = stream.Update(shown.frames[frame]);
      EXPECT_EQ(evidence.asked, trace->asked[frame]) << kind << frame;
      EXPECT_THAT(evidence.spotted, ::testing::ElementsAreArray(trace->SpottedAt(frame)));
    }
    EXPECT_GT(trace->asked[39], 0) << kind;
  }
}

}  // namespace
}  // namespace etude::engine
