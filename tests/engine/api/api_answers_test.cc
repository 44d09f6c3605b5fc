// The library's answers equal the engine's answers, or the values from which the input was made.
#include <etude/cameras.h>
#include <etude/capture.h>
#include <etude/coaching.h>
#include <etude/fuzzy.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "engine/cameras/rig_file.h"
#include "engine/coaching/session.h"
#include "engine/formats/bvh.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"
#include "engine/fuzzy/features.h"
#include "engine/keypoints/recover_person.h"
#include "engine/recognition/recognisers.h"
#include "engine/transitions/library/transition_points.h"
#include "tests/engine/coaching/small_dance.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/support/results.h"

namespace etude::engine {
namespace {

using ::testing::HasSubstr;

/// Returns the engine's cameras in front of a walker, in the library's types.
std::vector<NamedCamera> ApiCameras() {
  std::vector<NamedCamera> named;
  for (const Camera& camera : FourCameras()) named.push_back({"c" + std::to_string(named.size()), camera});
  return ReadRig(WriteRig(named), "rig.yaml");
}

std::string Complaint(const std::function<void()>& act) {
  try {
    act();
  } catch (const BadInput& error) {
    return error.what();
  }
  return "";
}

TEST(ApiCameras, AreReadWithAnyLens) {
  Camera fisheye = FourCameras()[2];
  fisheye.distortion = {.k1 = 0.01, .is_fisheye = true};
  const std::vector<NamedCamera> read = ReadRig(WriteRig(std::vector<NamedCamera>{{"wide", fisheye}}), "rig.yaml");
  ASSERT_EQ(read.size(), 1u);
  EXPECT_EQ(read[0].name, "wide");
  EXPECT_EQ(read[0].camera.distortion, fisheye.distortion);
  for (const glm::dvec3 p : {glm::dvec3(0, 1, 0), glm::dvec3(0.4, 0.2, -0.3), glm::dvec3(-0.5, 1.6, 0.2)}) {
    EXPECT_LT(glm::distance(*Project(read[0].camera, p), *Project(fisheye, p)), 1e-9);
  }
}

TEST(ApiCameras, CalibrateAndTriangulateGiveBackWhatWasShown) {
  const std::vector<NamedCamera> cameras = ApiCameras();
  std::vector<PointPair> pairs;
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 p(0.3 * (i % 4) - 0.5, 0.15 * (i % 7) + 0.3, 0.25 * (i % 5) - 0.5);
    pairs.push_back({p, *Project(cameras[1].camera, p)});
    std::vector<std::optional<glm::dvec2>> pixels;
    for (const NamedCamera& each : cameras) pixels.push_back(Project(each.camera, p));
    pixels[i % 4].reset();
    const TriangulatedPoint found = Triangulate(cameras, pixels);
    ASSERT_EQ(found.status, PointStatus::kOk);
    EXPECT_LT(glm::distance(found.position, p), 1e-7);
    EXPECT_LT(found.residual_px, 1e-5);
    for (auto& pixel : pixels) pixel.reset();
    pixels[0] = Project(cameras[0].camera, p);
    EXPECT_EQ(Triangulate(cameras, pixels).status, PointStatus::kTooFewViews);
  }
  const CalibratedCamera calibrated = Calibrate(pairs, 1280, 720);
  EXPECT_LT(calibrated.rms_px, 1e-3);
  EXPECT_LT(glm::distance(calibrated.camera.p_WC, cameras[1].camera.p_WC), 1e-3);
  EXPECT_NEAR(calibrated.camera.intrinsics.fx, 900, 1);
  EXPECT_EQ(calibrated.camera.intrinsics.width, 1280);
  for (PointPair& pair : pairs) pair.pixel.x += pair.world.y > 1 ? 4 : 0;
  EXPECT_GT(Calibrate(pairs, 1280, 720).rms_px, 0.05) << "the control";
}

TEST(ApiCapture, RecoversThePersonThatTheEngineRecovers) {
  const std::vector<NamedCamera> cameras = ApiCameras();
  RandomStream dice = WalkersDice("api");
  std::vector<SeenPeople> seen(4), straight(4);
  std::vector<ProjectionMatrix> matrices;
  for (std::size_t c = 0; c < 4; ++c) {
    matrices.push_back(MatrixOf(FourCameras()[c]));
    for (int k = 0; k < 30; ++k) seen[c].push_back({etude::Seen(FourCameras()[c], Walker(0.1, 0, k / 15.0), 1, dice)});
    straight[c] = UndistortPeople(FourCameras()[c], seen[c]);
  }
  for (const double smooth_hz : {0.0, 4.0}) {
    const CapturedMotion captured = Capture(cameras, seen, {.rate_hz = 15, .smooth_hz = smooth_hz});
    RecoverPersonOptions options = DefaultRecovery(15, 1280);
    options.cutoff_hz = smooth_hz;
    ASSERT_OK(wanted, RecoverPerson(matrices, straight, options));
    ASSERT_EQ(captured.motion.poses.size(), 30u);
    EXPECT_EQ(captured.motion.rate_hz, 15);
    for (std::size_t k = 0; k < 30; ++k) {
      for (std::size_t i = 0; i < kRoleCount; ++i) {
        EXPECT_LT(glm::distance(captured.motion.poses[k].joints[i], wanted->motion.poses[k].joints[i]), 1e-6);
      }
    }
    EXPECT_NEAR(captured.residual_px, wanted->report.residual_px, 1e-6);
    EXPECT_EQ(captured.is_held, wanted->is_held);
    ASSERT_OK(clip, ReadBvh(captured.bvh, "captured.bvh"));
    EXPECT_NEAR(clip->rate_hz, 15, 1e-6);
    std::vector<GlobalTransform> globals;
    ComputeGlobals(clip->skeleton, clip->frames.at(20), globals);
    const auto ankle = static_cast<std::size_t>(clip->skeleton.Find("left_ankle"));
    EXPECT_LT(glm::distance(globals.at(ankle).position, captured.motion.poses[20][Role::kLeftAnkle]), 1e-4);
  }
  EXPECT_THAT(Complaint([&] { Capture(cameras, seen, {.rate_hz = 0.9}); }), HasSubstr("1 to 1000"));
  EXPECT_THAT(Complaint([&] { Capture(cameras, seen, {.person = -1}); }), HasSubstr("person is -1"));
  EXPECT_THAT(Complaint([&] { Capture(cameras, seen, {.person = 1}); }), HasSubstr("person 2"));
  EXPECT_THAT(Complaint([&] { Capture(cameras, seen, {.smooth_hz = -1}); }), HasSubstr("0 or more"));
  seen[1][3][0][Landmark::kLeftShoulder].confidence = 1.5;
  EXPECT_THAT(Complaint([&] { Capture(cameras, seen); }), HasSubstr("keypoint LShoulder is at"));
}

TEST(ApiMotion, ReadsWhatTheEngineWrote) {
  const BodyMotion flap = Flap(30, 60);
  const Motion read = ReadMotion(WriteTrc(flap, "flap"), "flap.trc");
  ASSERT_EQ(read.poses.size(), 30u);
  EXPECT_EQ(read.rate_hz, 30);
  for (std::size_t k = 0; k < 30; ++k) {
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      EXPECT_LT(glm::distance(read.poses[k].joints[i], flap.poses[k].joints[i]), 1e-4) << k << " " << i;
    }
  }
  EXPECT_EQ(ReadMotion(WriteTrc(flap, "flap"), "flap.trc", 60).poses.size(), 59u);
  EXPECT_THAT(Complaint([&] { ReadMotion(WriteTrc(flap, "flap"), "flap.trc", 0.5); }), HasSubstr("the rate is 0.5 Hz"));
}

TEST(ApiMotion, LaysTheRowsOfACsvOnItsClock) {
  // Rows 10 to 19 of 60 are missing; the times show the gap.
  const BodyMotion flap = Flap(60, 30);
  std::istringstream lines(WriteJointCsv(flap));
  std::string text;
  int row = -1;
  for (std::string line; std::getline(lines, line); ++row) {
    if (row < 10 || row > 19) text += line + "\n";
  }
  const Motion read = ReadMotion(text, "a.csv");
  ASSERT_EQ(read.poses.size(), 60u);
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    EXPECT_LT(glm::distance(read.poses[40].joints[i], flap.poses[40].joints[i]), 1e-9);
  }
}

TEST(ApiMotion, KeepsTheFloorOfArraysWithOtherJointsAsTheCommandLineDoes) {
  const BodyMotion motion = Flap(30, 60);
  NumberArray positions{.shape = {motion.poses.size(), kRoleCount + 1, 3}, .values = {}};
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) {
      for (int axis = 0; axis < 3; ++axis) positions.values.push_back(joint[axis] + (axis == 1 ? 0.7 : 0));
    }
    for (const double place : {1.0, 1.0, 1.0}) positions.values.push_back(place);
  }
  std::vector<std::string> names;
  for (const Role role : AllRoles()) names.emplace_back(RoleName(role));
  names.emplace_back("ball");
  const std::string npz = WriteNpz({{"positions", positions}, {"rate_hz", {{}, {30}}}}, {{"names", names}});
  const Motion read = ReadMotion(npz, "a.npz", 30);
  EXPECT_NEAR(read.poses[3].joints[0].y, motion.poses[3].joints[0].y + 0.7, 1e-9);
}

TEST(ApiMotion, ReadsEtudesOwnTablesAsWrittenAndSaysEveryChange) {
  BodyMotion raised = Flap(30, 60);
  for (BodyPose& pose : raised.poses) {
    for (glm::dvec3& joint : pose.joints) joint.y += 0.175;
  }
  const auto farthest = [&](const Motion& read, double above) {
    double off = 0;
    for (std::size_t k = 0; k < read.poses.size(); ++k) {
      for (std::size_t i = 0; i < kRoleCount; ++i) {
        off =
            std::max(off, glm::distance(read.poses[k].joints[i], raised.poses[k].joints[i] - glm::dvec3(0, above, 0)));
      }
    }
    return off;
  };
  for (const std::string& bytes : {WriteJointCsv(raised), WriteTrc(raised, "raised")}) {
    std::vector<std::string> changes;
    const Motion read = ReadMotion(bytes, "raised", 30, {}, &changes);
    ASSERT_EQ(read.poses.size(), 30u);
    EXPECT_LT(farthest(read, 0), 1e-4);
    EXPECT_THAT(changes, ::testing::ElementsAre("Etude's joints"));
  }
  std::vector<std::string> changes;
  ReadMotion(WriteJointCsv(raised), "a.csv", 60, {.keep_floor = true, .up = 'z'}, &changes);
  EXPECT_THAT(changes, ::testing::ElementsAre("Etude's joints", "turned upright from Z up (given)",
                                              "resampled from 30 to 60 Hz"));
  EXPECT_THAT(Complaint([&] { ReadMotion(WriteJointCsv(raised), "a.csv", 30, {.up = 'w'}); }),
              HasSubstr("allowed: y, z"));
  EXPECT_THAT(Complaint([&] { ReadMotion(WriteJointCsv(raised), "a.csv", 30, {.marker_set = "opencup"}); }),
              HasSubstr("opencap"));
}

TEST(ApiFuzzy, FeaturesAndDistancesAreTheEngines) {
  const BodyMotion flap = Flap(40, 120);
  const double hips = StandingHipHeight(flap.poses.front());
  const auto features = ComputeFeatures(flap);
  ASSERT_EQ(features.size(), 40u);
  for (std::size_t k = 0; k < 40; ++k) {
    const PoseFeatures wanted = etude::ComputeFeatures(flap.poses[k], hips),
                       first = etude::ComputeFeatures(flap.poses[0], hips);
    EXPECT_EQ(features[k].values, wanted.values);
    EXPECT_EQ(FuzzyDistance(features[0], features[k]),
              ComputeDistance(Fuzzify(first), Fuzzify(wanted), PaperWeights()).value);
  }
  EXPECT_GT(FuzzyDistance(features[0], features[20]), 1) << "the control: arms went up";
  EXPECT_THAT(Complaint([&] { FuzzyDistance(features[0], PoseFeatures{{NAN}}); }), HasSubstr("not finite"));
}

TEST(ApiFuzzy, BridgesLeaveClipsWherePosesMatch) {
  const std::vector<Motion> clips = {Flap(60, 90), Flap(80, 90), Flap(50, 20)};
  const Bridges bridges(clips);
  ASSERT_FALSE(bridges.FramesOf(0).empty());
  EXPECT_TRUE(std::ranges::is_sorted(bridges.FramesOf(0)));
  ASSERT_OK(found, bridges.Find(0, 5, 1, 2));
  EXPECT_GE(found->from, 5);
  EXPECT_LE(found->from, 65);
  EXPECT_THAT(bridges.FramesOf(0), ::testing::Contains(found->from));
  EXPECT_THAT(bridges.FramesOf(1), ::testing::Contains(found->to));
  const auto a = ComputeFeatures(clips[0]), b = ComputeFeatures(clips[1]);
  EXPECT_NEAR(found->distance, FuzzyDistance(a[found->from], b[found->to]), 1e-9);
  EXPECT_LT(found->distance, 0.4);
  EXPECT_TRUE(Bridges(clips, {.min_clips = 4}).FramesOf(0).empty()) << "three clips share nothing in four";
  std::vector<Motion> mixed = clips;
  mixed[1].rate_hz = 60;
  EXPECT_THAT(Complaint([&] { Bridges{mixed}; }), HasSubstr("the rate of clip 1 is 60 Hz; allowed: 30 Hz, as in clip "
                                                            "0"));
}

std::vector<TaughtMove> SmallMoves() {
  return {{.name = "first", .examples = {StreamOf(Flap(90, 60))}},
          {.name = "second", .examples = {StreamOf(Flap(90, 30))}}};
}

TEST(ApiCoach, ShowsAndDecidesWhatTheEnginesCoachDoes) {
  const std::vector<TaughtMove> moves = SmallMoves();
  Coach coach(SmallDance(), moves, {.dances_at_once = true});
  const DanceLibrary library = DanceLibrary::Make(SmallDance()).value();
  const DanceTransitions transitions(library, {.choice = FindChoice("played"), .join = FindJoin("planted-feet")});
  const auto recogniser = MakeRecogniser({.kind = FindRecogniser("whole-body")}, moves).value();
  etude::CoachOptions options;
  options.right_from = FindRecogniser("whole-body")->threshold;
  options.sensor = {0, 1, 2.75};
  const etude::Coach twin(transitions, options, {FindPolicy("at-first-mistake"), {}});
  CoachSession session({.coach = &twin, .recogniser = recogniser.get(), .filter = {.kind = FilterKind::kNone}},
                       twin.BeginDancing());
  const BodyMotion player = Flap(700, 40);
  std::size_t decisions = 0;
  for (int k = 0; k < 700; ++k) {
    const std::optional<double> music_s = k > 20 ? std::optional(k / 30.0) : std::nullopt;
    const SensedFrame seen = StreamOf({.poses = {player.poses[k]}}).frames.front();
    const CoachOutput shown = coach.Step(seen, music_s);
    const CoachOutput wanted = session.Next(seen, {.music_s = music_s});
    ASSERT_EQ(shown.mode, wanted.mode) << k;
    ASSERT_EQ(shown.body.joints, wanted.body.joints) << k;
    EXPECT_EQ(shown.clip, wanted.clip);
    EXPECT_EQ(shown.clip_frame, wanted.clip_frame);
    EXPECT_EQ(shown.open, wanted.open);
    EXPECT_EQ(shown.say, wanted.say);
    EXPECT_EQ(shown.music.kind, wanted.music.kind);
    ASSERT_EQ(shown.records.size(), wanted.records.size());
    for (std::size_t i = 0; i < wanted.records.size(); ++i, ++decisions) {
      EXPECT_EQ(shown.records[i].event, wanted.records[i].event);
      EXPECT_EQ(shown.records[i].evidence, wanted.records[i].evidence);
      EXPECT_EQ(shown.records[i].why, wanted.records[i].why);
    }
  }
  EXPECT_GT(decisions, 3u) << "something was decided";
}

TEST(ApiCoach, RefusesWhatIsNotOfTheDance) {
  const std::vector<TaughtMove> moves = SmallMoves();
  const auto refusal = [&](const CoachOptions& options, std::span<const TaughtMove> taught) {
    return Complaint([&] { Coach(SmallDance(), taught, options); });
  };
  EXPECT_EQ(refusal({}, moves), "");
  EXPECT_THAT(refusal({}, std::span(moves).first(1)),
              HasSubstr("found 1 moves; allowed: 2, one for each move of the dance"));
  EXPECT_THAT(refusal({}, std::vector{moves[1], moves[0]}),
              HasSubstr("move 0 is 'second'; allowed: 'first', the move with this number in the dance"));
  EXPECT_THAT(refusal({.policy = "sometimes"}, moves), HasSubstr("policy 'sometimes'; allowed: "));
  EXPECT_THAT(refusal({.choice = "none"}, moves), HasSubstr("choice 'none'; allowed: "));
  EXPECT_THAT(refusal({.right_from = 0.0}, moves), HasSubstr("above 0, up to 1"));
  EXPECT_THAT(refusal({.right_from = 1.01}, moves), HasSubstr("above 0, up to 1"));
  EXPECT_EQ(refusal({.right_from = 1.0}, moves), "");
  EXPECT_THAT(refusal({.sensor_m = {0, NAN, 2}}, moves), HasSubstr("sensor_m is not finite"));
  EXPECT_THAT(RequiredActs(), ::testing::Contains("head_shake"));
  EXPECT_THAT(CoachPolicies(), ::testing::Contains("at-first-mistake"));
  Coach coach(SmallDance(), moves);
  EXPECT_THAT(Complaint([&] { coach.Step({}, -1.0); }), HasSubstr("music_s is -1; allowed: 0 to 1e6, or none"));
}

}  // namespace
}  // namespace etude::engine
