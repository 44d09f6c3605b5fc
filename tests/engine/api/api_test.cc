// The library gives what the engine gives, and refuses with reasons what the engine only asserts.
#include <etude/capture.h>
#include <etude/fuzzy.h>
#include <etude/kinematics.h>
#include <etude/recognition.h>
#include <etude/vision.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/kinematics/body_tree.h"
#include "engine/kinematics/solvers/gauss_newton.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "engine/vision/person_finder.h"

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

/// Problems whose starts and wanted angles lie within the limits, told by fractions that repeat never.
IkBatch SomeProblems(const Kinematics& body, int count) {
  IkBatch batch{.roots = {Frame{}}, .starts = {}, .targets = {}};
  double fraction = 0.5;
  const auto draw = [&](const AngleRange& range, double share) {
    fraction += 0.6180339887498949;
    fraction -= static_cast<int>(fraction);
    return (range.lower + range.upper) / 2 + share * (fraction - 0.5) * (range.upper - range.lower);
  };
  for (int i = 0; i < count; ++i) {
    TreePose wanted;
    for (const AngleRange& range : body.tree().limits) {
      wanted.angles.push_back(draw(range, 0.6));
      batch.starts.push_back(draw(range, 0.1));
    }
    for (const Frame& frame : body.Effectors(wanted)) batch.targets.push_back({frame});
  }
  return batch;
}

TEST(ApiKinematics, SolvesWhatTheEngineSolvesToTheLastBit) {
  const Kinematics body(AdultBody());
  const KinematicTree tree = MakeBodyTree({});
  const IkBatch batch = SomeProblems(body, 9);
  const IkBatchAnswer answer = body.Solve(batch);
  ASSERT_EQ(answer.statuses.size(), 9u);
  const std::size_t dofs = body.dofs(), ends = tree.effectors.size();
  EXPECT_EQ(dofs, 29u);
  for (std::size_t i = 0; i < 9; ++i) {
    IkProblem problem{StandingState(tree), {}, tree.limits};
    problem.start.root_frame = glm::dmat3(1);
    problem.start.angles.assign(&batch.starts[i * dofs], &batch.starts[i * dofs] + dofs);
    for (std::size_t e = 0; e < ends; ++e) {
      const Target& target = batch.targets[i * ends + e];
      problem.targets.push_back({target.frame.position, target.frame.axes});
    }
    const IkSolution wanted = SolveGaussNewton(tree, problem, {});
    EXPECT_EQ(wanted.status, etude::IkStatus::kConverged);
    EXPECT_EQ(answer.statuses[i], IkStatus::kConverged);
    EXPECT_EQ(answer.iterations[i], wanted.iterations);
    const std::vector<double> row(&answer.angles[i * dofs], &answer.angles[i * dofs] + dofs);
    EXPECT_EQ(row, wanted.angles);
    const TreePose start{{}, problem.start.angles};
    EXPECT_EQ(body.Solve(start, std::span(&batch.targets[i * ends], ends)).angles, wanted.angles);
  }
}

TEST(ApiKinematics, MeetsTargetsInFloatsAndWithRootsOfTheirOwn) {
  const Kinematics body(AdultBody());
  IkBatch batch = SomeProblems(body, 5);
  const glm::dvec3 moved{3, 1, -2};
  batch.roots.assign(5, Frame{moved, glm::dmat3(1)});
  for (Target& target : batch.targets) target.frame.position += moved;
  const IkBatchAnswer answer = body.Solve(batch, Precision::kFloat);
  for (std::size_t i = 0; i < 5; ++i) {
    ASSERT_EQ(answer.statuses[i], IkStatus::kConverged);
    TreePose pose{batch.roots[i], {}};
    pose.angles.assign(answer.angles.begin() + i * 29, answer.angles.begin() + (i + 1) * 29);
    const auto ends = body.Effectors(pose);
    for (std::size_t e = 0; e < ends.size(); ++e) {
      EXPECT_LT(glm::distance(ends[e].position, batch.targets[i * ends.size() + e].frame.position), 0.001);
    }
  }
}

TEST(ApiKinematics, RefusesWhatDoesNotFit) {
  EXPECT_THAT(Refusal([] { Kinematics{Tree{}}; }), Not(::testing::IsEmpty()));
  Tree circle = AdultBody();
  circle.limbs[3].parent = 7;
  EXPECT_THAT(Refusal([&] { Kinematics{circle}; }), Not(::testing::IsEmpty()));
  const Kinematics body(AdultBody());
  EXPECT_THAT(Refusal([&] { body.Limbs({}); }), HasSubstr("0 angles; allowed: 29"));
  EXPECT_THAT(Refusal([&] {
                body.Solve(TreePose{{}, std::vector<double>(29)}, std::span<const Target>());
              }),
              Not(::testing::IsEmpty()));
  IkBatch batch = SomeProblems(body, 2);
  batch.starts.pop_back();
  EXPECT_THAT(Refusal([&] { body.Solve(batch); }), HasSubstr("57 start angles; allowed: 58"));
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
  const std::vector<Camera> two(2);
  EXPECT_THAT(Refusal([&] { Triangulate(two, {}); }), HasSubstr("0 pixels"));
  const std::vector<SeenPeople> none(2);
  EXPECT_THAT(Refusal([&] { Capture(two, none); }), HasSubstr("0 frames"));
  const std::vector<SeenPeople> short_lists(2, SeenPeople(1, {SeenPerson(3)}));
  EXPECT_THAT(Refusal([&] { Capture(two, short_lists); }), HasSubstr("3 keypoints; allowed: those of layout coco, 17"));
}

/// A standing body whose right arm swings so many times, its joints told apart by their places alone.
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
  const std::vector<TaughtMove> moves = {{"once", {Swinging(1)}}, {"thrice", {Swinging(3)}}};
  for (const std::string kind : {"whole-body", "dtw", "nearest"}) {
    RecogniserStream stream = Recogniser(moves, {.kind = kind}).Follow();
    stream.Ask(1);
    std::vector<etude::TaughtMove> taught;
    SkeletonStream shown;
    for (const TaughtMove& move : moves) {
      etude::TaughtMove& told = taught.emplace_back(etude::TaughtMove{.name = move.name});
      BodyMotion body;
      for (const Pose& pose : move.examples.front().poses) body.poses.push_back({pose.joints});
      told.examples.push_back(StreamOf(body));
      shown = told.examples.back();
    }
    const auto recogniser = MakeRecogniser({.kind = FindRecogniser(kind)}, taught);
    ASSERT_TRUE(recogniser);
    FilterOptions filter;
    filter.kind = FilterKind::kHolt;
    const std::vector<AskedMove> asked = {{1, {0, 40}}};
    const auto trace = FollowStream(**recogniser, 2, SeeStream(shown, filter), asked);
    ASSERT_TRUE(trace);
    for (int frame = 0; frame < 40; ++frame) {
      const Evidence evidence = stream.Update({.pose = Swinging(3).poses[frame], .seen = {}});
      EXPECT_EQ(evidence.asked, trace->asked[frame]) << kind << frame;
      EXPECT_THAT(evidence.spotted, ::testing::ElementsAreArray(trace->SpottedAt(frame)));
    }
    EXPECT_GT(trace->asked[39], 0) << kind;
  }
}

TEST(ApiVision, FindsThePersonThatTheEngineFinds) {
  ColourImage room(40, 30, {90, 120, 150}), picture = room;
  for (int y = 5; y < 25; ++y) {
    for (int x = 10; x < 20; ++x) picture.At(x, y) = {200, 60, static_cast<std::uint8_t>(40 + x)};
  }
  const auto bytes = [](const ColourImage& image) {
    return std::span(reinterpret_cast<const std::uint8_t*>(image.pixels.data()), 3 * image.pixels.size());
  };
  PersonFinder finder(bytes(room), 40, 30);
  const Mask wanted = ExtractPerson(room, picture, {.segmenter = Segmenter::kHueGated, .change = {}});
  EXPECT_EQ(finder.Find(bytes(picture)), wanted.pixels);
  EXPECT_EQ(std::ranges::count(wanted.pixels, 1), 200);
  EXPECT_THAT(Refusal([&] { finder.Find(bytes(room).subspan(3)); }), HasSubstr("allowed: 40 x 30 x 3"));
}

}  // namespace
}  // namespace etude::engine
