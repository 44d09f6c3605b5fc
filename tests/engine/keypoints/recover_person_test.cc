#include "engine/keypoints/recover_person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "engine/base/angles.h"
#include "engine/keypoints/agreement.h"
#include "tests/engine/keypoints/walkers.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

constexpr std::size_t kPersonFrames = 60;
constexpr double kRate = 30;
constexpr double kFirstX = -0.5, kSecondX = 0.7;

/// Returns two people side by side in some of the four cameras, in an order that changes per frame.
std::vector<SeenPeople> TwoWalkers(const std::vector<Camera>& cameras, double sigma_px) {
  RandomStream dice = WalkersDice("errors");
  std::vector<SeenPeople> people(cameras.size(), SeenPeople(kPersonFrames));
  for (std::size_t c = 0; c < cameras.size(); ++c) {
    for (std::size_t k = 0; k < kPersonFrames; ++k) {
      const double t = static_cast<double>(k) / kRate;
      people[c][k].push_back(Seen(cameras[c], Walker(kFirstX, 0, t), sigma_px, dice));
      people[c][k].push_back(Seen(cameras[c], Walker(kSecondX, 0.2, t + 0.4), sigma_px, dice));
      if ((k * 7 + c) % 3 == 0) std::swap(people[c][k][0], people[c][k][1]);
    }
  }
  return people;
}

RecoverPersonOptions WalkOptions() { return {.rate_hz = kRate, .match = {}, .triangulate = {}}; }

/// Recovers a person as a tool does, with the lenses undone.
Result<RecoveredPerson> Recover(std::span<const Camera> cameras, std::span<const SeenPeople> people,
                                const RecoverPersonOptions& options) {
  std::vector<SeenPeople> straight;
  for (std::size_t c = 0; c < cameras.size(); ++c) straight.push_back(UndistortPeople(cameras[c], people[c]));
  return RecoverPerson(MatricesOf({cameras.begin(), cameras.end()}), straight, options);
}

/// Returns the largest distance of a landmark from the walker's, metres.
double WorstOff(const std::vector<LandmarkPositions>& found, double x, double z, double later) {
  double worst = 0;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const LandmarkPositions truth = Walker(x, z, static_cast<double>(k) / kRate + later);
    for (std::size_t i = 0; i < kLandmarkCount; ++i) {
      if (truth[i]) worst = std::max(worst, found[k][i] ? glm::distance(*found[k][i], *truth[i]) : 9.0);
    }
  }
  return worst;
}

TEST(MatchPeople, TellsTwoPersonsApartInFourCamerasWhateverTheirOrder) {
  const std::vector<Camera> cameras = Pinholes();
  const auto people = MatchPeople(MatricesOf(cameras), TwoWalkers(cameras, 2));
  ASSERT_EQ(people.size(), 2u);
  for (const MatchedPerson& person : people) {
    EXPECT_EQ(person.cameras, 4u);
    // Every keypoint must belong to the same walker.
    const auto truth = [&](double x, double z, double later) {
      double worst = 0;
      for (std::size_t c = 0; c < 4; ++c) {
        for (std::size_t k = 0; k < kPersonFrames; ++k) {
          const LandmarkPositions places = Walker(x, z, static_cast<double>(k) / kRate + later);
          if (!person.seen[c][k]) return 1e9;
          const Keypoint& hip = (*person.seen[c][k])[Landmark::kLeftHip];
          worst = std::max(worst, glm::distance(hip.pixel, *Project(cameras[c], *places[Index(Landmark::kLeftHip)])));
        }
      }
      return worst;
    };
    const double first = truth(kFirstX, 0, 0), second = truth(kSecondX, 0.2, 0.4);
    EXPECT_LT(std::min(first, second), 12);
    EXPECT_GT(std::max(first, second), 50) << "the control: the walkers are apart";
  }
}

TEST(MatchPeople, JoinsWhatACameraLostForAWhileByTheOthers) {
  const std::vector<Camera> cameras = Pinholes();
  auto people = TwoWalkers(cameras, 1);
  for (std::size_t k = 15; k < 40; ++k) people[1][k].clear();
  const auto matched = MatchPeople(MatricesOf(cameras), people);
  ASSERT_EQ(matched.size(), 2u);
  for (const MatchedPerson& person : matched) {
    EXPECT_TRUE(person.seen[1][10] && person.seen[1][50]);
    EXPECT_FALSE(person.seen[1][20]);
  }
}

TEST(MatchPeople, LeavesAPersonAloneWhomNoOtherCameraSees) {
  const std::vector<Camera> cameras = Pinholes();
  RandomStream dice = WalkersDice("bystander");
  std::vector<SeenPeople> people(4, SeenPeople(kPersonFrames));
  for (std::size_t k = 0; k < kPersonFrames; ++k) {
    const double t = static_cast<double>(k) / kRate;
    for (std::size_t c = 0; c < 4; ++c) people[c][k].push_back(Seen(cameras[c], Walker(0, 0, t), 1, dice));
    people[2][k].push_back(Seen(cameras[2], Walker(1.5, -1, 0.2 * t), 1, dice));
  }
  const auto matched = MatchPeople(MatricesOf(cameras), people);
  ASSERT_EQ(matched.size(), 2u);
  EXPECT_EQ(matched[0].cameras, 4u);
  EXPECT_EQ(matched[1].cameras, 1u);
  EXPECT_GT(matched[0].sightings, matched[1].sightings);
}

TEST(RecoverPerson, GivesExactKeypointsPlacesBackThroughLenses) {
  const std::vector<Camera> cameras = FourCameras();
  ASSERT_OK(person, Recover(cameras, TwoWalkers(cameras, 0), WalkOptions()));
  const double first = WorstOff(person->landmarks, kFirstX, 0, 0),
               second = WorstOff(person->landmarks, kSecondX, 0.2, 0.4);
  EXPECT_LT(std::min(first, second), 1e-6);
  EXPECT_NEAR(person->body.lengths.shank, 0.42, 1e-6);
  EXPECT_NEAR(person->body.lengths.upper_arm, 0.29, 1e-6);
  EXPECT_NEAR(person->body.lengths.hand, 0.72 * 0.25, 1e-6);
  EXPECT_EQ(std::ranges::count(person->is_held, true), 0);
  EXPECT_EQ(person->motion.poses.size(), kPersonFrames);
  EXPECT_EQ(person->clip.frames.size(), kPersonFrames);
}

std::vector<SeenPeople> OneWalker(const std::vector<Camera>& cameras, double sigma_px) {
  RandomStream dice = WalkersDice("one");
  std::vector<SeenPeople> people(cameras.size(), SeenPeople(kPersonFrames));
  for (std::size_t k = 0; k < kPersonFrames; ++k) {
    const LandmarkPositions walker = Walker(0, 0, static_cast<double>(k) / kRate);
    for (std::size_t c = 0; c < cameras.size(); ++c) people[c][k].push_back(Seen(cameras[c], walker, sigma_px, dice));
  }
  return people;
}

/// Returns the largest distance of a skeleton's joint from the walker's, metres.
double WorstJoint(const RecoveredPerson& person) {
  double worst = 0;
  for (std::size_t k = 0; k < kPersonFrames; ++k) {
    const RoleVectors truth = JointsOf(Walker(0, 0, static_cast<double>(k) / kRate));
    for (const Role role : AllRoles()) {
      if (!truth[Index(role)]) continue;
      worst = std::max(worst, glm::distance(person.motion.poses[k][role], *truth[Index(role)]));
    }
  }
  return worst;
}

TEST(RecoverPerson, ItsSkeletonStandsWhereThePointsAre) {
  const std::vector<Camera> cameras = FourCameras();
  ASSERT_OK(person, Recover(cameras, OneWalker(cameras, 0), WalkOptions()));
  EXPECT_LT(WorstJoint(*person), 1e-5);
}

TEST(RecoverPerson, ItsSkeletonIsNearerToTheTruthThanNoisyPoints) {
  const std::vector<Camera> cameras = FourCameras();
  ASSERT_OK(person, Recover(cameras, OneWalker(cameras, 2), WalkOptions()));
  std::vector<LandmarkPositions> walk;
  for (std::size_t k = 0; k < kPersonFrames; ++k) walk.push_back(Walker(0, 0, static_cast<double>(k) / kRate));
  const MarkerMotion truth = JointMarkers(walk, kRate);
  const MarkerAgreement skeleton = CompareAllMarkers(JointMarkers(person->motion), truth);
  const MarkerAgreement points = CompareAllMarkers(JointMarkers(person->landmarks, kRate), truth);
  EXPECT_EQ(skeleton.frames, 19 * kPersonFrames) << "all but the spine";
  EXPECT_GT(points.median_mm, 4) << "the control: 2 px are 9 mm at 4 m, of which four cameras leave a half";
  EXPECT_LT(skeleton.median_mm, points.median_mm);
  EXPECT_LT(skeleton.p95_mm, points.p95_mm);
}

TEST(RecoverPerson, ItsClipHasTheJointsWhereTheMotionHas) {
  const std::vector<Camera> cameras = FourCameras();
  ASSERT_OK(person, Recover(cameras, OneWalker(cameras, 2), WalkOptions()));
  std::vector<GlobalTransform> globals;
  for (const Role role : {Role::kLeftKnee, Role::kRightAnkle, Role::kLeftElbow, Role::kRightWrist, Role::kHead}) {
    const int joint = person->clip.skeleton.Find(std::string(RoleName(role)));
    ASSERT_GE(joint, 0) << RoleName(role);
    for (std::size_t k = 0; k < kPersonFrames; ++k) {
      ComputeGlobals(person->clip.skeleton, person->clip.frames[k], globals);
      EXPECT_LT(glm::distance(globals[joint].position, person->motion.poses[k][role]), 1e-9) << RoleName(role);
    }
  }
}

TEST(RecoverPerson, RefusesWhatIsNoSession) {
  const std::vector<Camera> cameras = FourCameras();
  const auto people = TwoWalkers(cameras, 1);
  // The second of two cameras is tilted by 10° against the rig.
  std::vector<Camera> moved{cameras[0], cameras[1]};
  const double sine = std::sin(Radians(10)), cosine = std::cos(Radians(10));
  moved[1].R_CW = glm::transpose(glm::dmat3(1, 0, 0, 0, cosine, -sine, 0, sine, cosine)) * moved[1].R_CW;
  EXPECT_THAT(testing::Message(Recover(moved, std::span(people).first(2), WalkOptions())),
              HasSubstr("no two cameras see the same person at the same place"));
  RecoverPersonOptions third = WalkOptions();
  third.person = 2;
  EXPECT_THAT(Recover(cameras, people, third).error().message,
              HasSubstr("there is no person 3; number of people seen by two or more cameras: 2"));
}

TEST(InterpolatePoints, FillsShortGapsStraightAndNoLongOnes) {
  std::vector<LandmarkPositions> frames(12);
  frames[0][0] = glm::dvec3(0);
  frames[4][0] = glm::dvec3(4, 8, 0);
  frames[11][0] = glm::dvec3(1);
  InterpolatePoints(frames, 3);
  ASSERT_TRUE(frames[1][0]);
  EXPECT_LT(glm::distance(*frames[1][0], glm::dvec3(1, 2, 0)), 1e-12);
  EXPECT_FALSE(frames[7][0]) << "six frames are more than three";
}

TEST(SmoothPoints, HalvesThePowerAtTheCutoffAndKeepsWhatIsSlow) {
  const auto gain = [](double frequency_hz) {
    constexpr double kHz = 120;
    std::vector<LandmarkPositions> frames(480);
    for (std::size_t k = 0; k < frames.size(); ++k) {
      frames[k][0] = glm::dvec3(std::sin(2 * kPi * frequency_hz * static_cast<double>(k) / kHz), 0, 0);
    }
    SmoothPoints(frames, kHz, 6);
    double most = 0;
    for (std::size_t k = 100; k < 380; ++k) most = std::max(most, frames[k][0]->x);
    return most;
  };
  EXPECT_NEAR(gain(6), std::sqrt(0.5), 0.01);
  EXPECT_GT(gain(0.5), 0.99);
  EXPECT_LT(gain(20), 0.05);
}

TEST(InterpolatePoints, BridgesAGapOfJustSoManyFrames) {
  for (const std::size_t longest : {2u, 3u}) {
    std::vector<LandmarkPositions> frames(5);
    frames[0][3] = glm::dvec3(0);
    frames[4][3] = glm::dvec3(8);
    InterpolatePoints(frames, longest);
    EXPECT_EQ(frames[1][3].has_value(), longest == 3);
  }
}

TEST(SmoothPoints, ChangesNothingFromHalfTheRateOnAndKeepsStraightWaysToTheirEnds) {
  for (const double cutoff_hz : {3.0, 15.0}) {
    std::vector<LandmarkPositions> frames(40);
    for (std::size_t k = 0; k < frames.size(); ++k) frames[k][0] = glm::dvec3(static_cast<double>(k), k % 2, 1);
    const auto before = frames;
    SmoothPoints(frames, 30, cutoff_hz);
    for (std::size_t k = 0; k < frames.size(); ++k) EXPECT_NEAR(frames[k][0]->x, before[k][0]->x, 1e-9) << k;
    EXPECT_EQ(frames == before, cutoff_hz == 15);
    EXPECT_NEAR(frames[20][0]->y, cutoff_hz == 15 ? 0 : 0.5, 0.01) << "what alternates";
    EXPECT_EQ(frames[0][0], before[0][0]) << "the ends have nothing on the other side";
  }
}

TEST(JointsOf, MakesUpHandsHeadAndFeetWhereNoLandmarkTellsThem) {
  using enum Landmark;
  LandmarkPositions marks = Walker(0, 0, 0.2);
  const auto joint = [&](Role role) { return JointsOf(marks)[Index(role)]; };
  EXPECT_EQ(joint(Role::kHead), marks[Index(kHead)]);
  EXPECT_EQ(joint(Role::kLeftFoot), marks[Index(kLeftBigToe)]);
  EXPECT_EQ(joint(Role::kHipCentre), 0.5 * (*marks[Index(kLeftHip)] + *marks[Index(kRightHip)]));
  marks[Index(kRightHand)] = glm::dvec3(1, 2, 3);
  EXPECT_EQ(joint(Role::kRightHand), glm::dvec3(1, 2, 3));
  marks[Index(kHead)].reset();
  EXPECT_EQ(joint(Role::kHead), marks[Index(kNose)]);
  marks[Index(kLeftEar)] = glm::dvec3(0.08, 1.6, 0);
  marks[Index(kRightEar)] = glm::dvec3(-0.08, 1.6, 0.1);
  EXPECT_LT(glm::distance(*joint(Role::kHead), glm::dvec3(0, 1.6, 0.05)), 1e-12) << "midway between the ears";
  for (const Landmark gone : {kLeftEar, kRightEar, kNose}) marks[Index(gone)].reset();
  EXPECT_LT(glm::distance(*joint(Role::kHead), glm::dvec3(0, 0.92 + 1.5 * 0.5, 0)), 1e-12) << "half a trunk above it";
  for (const Landmark toe : {kLeftBigToe, kRightBigToe}) marks[Index(toe)].reset();
  for (const auto& [foot, ankle] : {std::pair(Role::kLeftFoot, kLeftAnkle), {Role::kRightFoot, kRightAnkle}}) {
    const glm::dvec3 ahead = *joint(foot) - *marks[Index(ankle)];
    EXPECT_NEAR(glm::length(ahead), 0.18, 1e-3);
    EXPECT_NEAR(ahead.z, 0.18 * 0.95, 1e-9) << "the walker faces +z";
    EXPECT_LT(ahead.y, 0);
  }
  marks[Index(kLeftHip)].reset();
  EXPECT_FALSE(joint(Role::kHipCentre) || joint(Role::kHead) || joint(Role::kRightFoot)) << "nothing tells the front";
}

TEST(DefaultRecovery, FollowsTheRateAndThePictures) {
  const RecoverPersonOptions options = DefaultRecovery(60, 1920);
  EXPECT_EQ(options.rate_hz, 60);
  EXPECT_EQ(options.match.follow.max_absence, 30) << "half a second";
  EXPECT_EQ(options.match.follow.max_return, 180) << "three seconds";
  EXPECT_DOUBLE_EQ(options.triangulate.robust.outlier_px, 57.6) << "3 % of the longer side";
  EXPECT_EQ(DefaultRecovery(1, 640).match.follow.max_absence, 1);
}

TEST(RecoverPerson, ShowsTheLastPoseWhereNobodyIsSeenAndTheFirstBeforeThat) {
  const std::vector<Camera> cameras = FourCameras();
  auto people = OneWalker(cameras, 0);
  for (SeenPeople& camera : people) {
    for (std::size_t k = 0; k < kPersonFrames; ++k) {
      if (k < 4 || k >= 40) camera[k].clear();
    }
  }
  ASSERT_OK(person, Recover(cameras, people, WalkOptions()));
  for (std::size_t k = 0; k < kPersonFrames; ++k) {
    EXPECT_EQ(person->is_held[k], k < 4 || k >= 40) << k;
    const std::size_t shown = std::clamp<std::size_t>(k, 4, 39);
    EXPECT_EQ(person->motion.poses[k].joints, person->motion.poses[shown].joints) << k;
  }
  EXPECT_NEAR(person->report.found, 36.0 / kPersonFrames, 1e-12);
}

TEST(RecoverPerson, MendsSidesAndSetsItsLimitByTheResidualsWhenAsked) {
  const std::vector<Camera> cameras = FourCameras();
  auto people = OneWalker(cameras, 0.5);
  for (std::size_t k = 10; k < 30; ++k) people[2][k][0] = WithSidesSwapped(people[2][k][0]);
  RecoverPersonOptions options = DefaultRecovery(kRate, 1280);
  options.corrects = true;
  options.min_outlier_px = 3;
  ASSERT_OK(mended, Recover(cameras, people, options));
  ASSERT_EQ(mended->corrections.size(), 1u);
  EXPECT_EQ(mended->corrections[0].camera, 2u);
  EXPECT_LT(WorstOff(mended->landmarks, 0, 0, 0), 0.03);
  EXPECT_GE(mended->outlier_px, 3);
  EXPECT_LT(mended->outlier_px, 10);
  options.corrects = false;
  ASSERT_OK(raw, Recover(cameras, people, options));
  EXPECT_TRUE(raw->corrections.empty());
  EXPECT_DOUBLE_EQ(raw->outlier_px, 0.03 * 1280);
  EXPECT_GT(raw->report.rejected[2], mended->report.rejected[2]) << "the control";
}

TEST(JointMarkers, AreLandmarksAndMarkersOfTheirNames) {
  const std::vector<LandmarkPositions> frames = {Walker(0, 0, 0), Walker(0, 0, 0.1)};
  const MarkerMotion markers = ToMarkers(frames, 25);
  EXPECT_EQ(markers.rate_hz, 25);
  EXPECT_EQ(std::ranges::count(markers.names, "LBigToe"), 1);
  EXPECT_EQ(std::ranges::count(markers.names, "LHeel"), 0) << "never seen";
  EXPECT_EQ(ToLandmarks(markers), frames);
}

TEST(TriangulatePerson, TellsWhichCameraDisagreed) {
  const std::vector<Camera> cameras = Pinholes();
  RandomStream dice = WalkersDice("one");
  MatchedPerson person;
  person.seen.assign(4, std::vector<std::optional<SeenPerson>>(20));
  for (std::size_t k = 0; k < 20; ++k) {
    for (std::size_t c = 0; c < 4; ++c)
      person.seen[c][k] = Seen(cameras[c], Walker(0, 0, 0.03 * static_cast<double>(k)), 1, dice);
    for (Keypoint& keypoint : person.seen[2][k]->keypoints) keypoint.pixel += glm::dvec2(200, -90);
  }
  TriangulationReport report;
  const auto places = TriangulatePerson(MatricesOf(cameras), person, {}, &report);
  EXPECT_LT(WorstOff(places, 0, 0, 0) > 1 ? 9 : 0, 1) << "nothing is missing";
  ASSERT_EQ(report.rejected.size(), 4u);
  EXPECT_GT(report.rejected[2], 0.99);
  EXPECT_LT(report.rejected[0], 0.01);
  EXPECT_DOUBLE_EQ(report.found, 1);
}

TEST(TriangulatePerson, RejectsNothingOfACameraThatShowsNothing) {
  MatchedPerson person;
  person.seen.assign(4, std::vector<std::optional<SeenPerson>>(3));
  TriangulationReport report;
  TriangulatePerson(MatricesOf(Pinholes()), person, {}, &report);
  EXPECT_EQ(report.rejected, std::vector<double>(4, 0.0));
  EXPECT_EQ(report.found, 0);
}

}  // namespace
}  // namespace etude
