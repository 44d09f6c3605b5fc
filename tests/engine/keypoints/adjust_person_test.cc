#include "engine/keypoints/adjust_person.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "engine/base/order_statistics.h"
#include "engine/keypoints/agreement.h"
#include "tests/engine/keypoints/walkers.h"

namespace etude {
namespace {

constexpr std::size_t kTakeFrames = 60;
constexpr double kTakeRate = 30;

/// A walker in front of some of the four cameras, and its frame-by-frame recovery from keypoints.
struct WalkedTake {
  std::vector<ProjectionMatrix> cameras;
  RecoveredPerson person;

  WalkedTake(std::size_t count, double sigma_px, const std::function<void(std::vector<SeenPeople>&)>& change = {}) {
    RandomStream dice = WalkersDice("adjusted");
    std::vector<SeenPeople> people(count, SeenPeople(kTakeFrames));
    std::vector<Camera> all = FourCameras();
    for (std::size_t c = 0; c < count; ++c) {
      all[c].distortion = {};
      cameras.push_back(MatrixOf(all[c]));
      for (std::size_t k = 0; k < kTakeFrames; ++k) {
        people[c][k].push_back(Seen(all[c], Walker(0, 0, static_cast<double>(k) / kTakeRate), sigma_px, dice));
      }
    }
    if (change) change(people);
    person = *RecoverPerson(cameras, people, DefaultRecovery(kTakeRate, 1280));
  }

  bool Adjust() { return AdjustPerson(cameras, person.people[0], {.rate_hz = kTakeRate}, person); }
};

/// Returns the distances (mm) between the person's and the walker's joints, from frame `first` on, for all joints
/// that have landmarks.
std::vector<double> JointErrorsMm(const RecoveredPerson& person, std::size_t first = 0) {
  constexpr double kMm = 1000;
  std::vector<double> errors;
  for (std::size_t k = first; k < kTakeFrames; ++k) {
    const RoleVectors truth = JointsOf(Walker(0, 0, static_cast<double>(k) / kTakeRate));
    for (const Role role : AllRoles()) {
      if (truth[Index(role)]) errors.push_back(kMm * glm::distance(person.motion.poses[k][role], *truth[Index(role)]));
    }
  }
  return errors;
}

TEST(AdjustPerson, LeavesExactKeypointsWhereTheyAre) {
  WalkedTake take(2, 0);
  ASSERT_TRUE(take.Adjust());
  EXPECT_LT(std::ranges::max(JointErrorsMm(take.person)), 2);
  EXPECT_LT(UpperMedian(JointErrorsMm(take.person)), 0.2);
  EXPECT_NEAR(take.person.body.lengths.shank, 0.42, 1e-3);
  EXPECT_NEAR(take.person.body.lengths.upper_arm, 0.29, 1e-3);
}

TEST(AdjustPerson, IsFarNearerToTheTruthThanFramesByThemselves) {
  for (const auto& [cameras, sigma_px] : {std::pair(2u, 2.0), {4u, 8.0}}) {
    WalkedTake take(cameras, sigma_px);
    const double before = UpperMedian(JointErrorsMm(take.person));
    ASSERT_TRUE(take.Adjust());
    EXPECT_LT(UpperMedian(JointErrorsMm(take.person)), 0.6 * before) << sigma_px << " px, " << cameras << " cameras";
    EXPECT_NEAR(take.person.body.lengths.shank, 0.42, 0.004 * sigma_px);
  }
}

TEST(AdjustPerson, ItsClipHasTheAdjustedJoints) {
  WalkedTake take(3, 2);
  ASSERT_TRUE(take.Adjust());
  std::vector<GlobalTransform> globals;
  const int knee = take.person.clip.skeleton.Find(std::string(RoleName(Role::kLeftKnee)));
  ASSERT_GE(knee, 0);
  for (std::size_t k = 0; k < kTakeFrames; ++k) {
    ComputeGlobals(take.person.clip.skeleton, take.person.clip.frames[k], globals);
    EXPECT_LT(
        glm::distance(globals[static_cast<std::size_t>(knee)].position, take.person.motion.poses[k][Role::kLeftKnee]),
        1e-9);
  }
}

// Without the penalty on velocity, an unseen motion would continue for ever.
TEST(AdjustPerson, WhatIsNoLongerSeenStaysAboutWhereItWas) {
  constexpr std::size_t kLast = 30;
  WalkedTake take(2, 1, [](std::vector<SeenPeople>& people) {
    for (SeenPeople& camera : people) {
      for (std::size_t k = kLast; k < kTakeFrames; ++k) camera[k].clear();
    }
  });
  const BodyPose held = take.person.motion.poses.back();
  ASSERT_TRUE(take.Adjust());
  for (const Role role : AllRoles()) {
    EXPECT_LT(glm::distance(take.person.motion.poses.back()[role], held[role]), 0.2) << RoleName(role);
  }
}

TEST(AdjustPerson, IsNotThrownByWhatOneCameraShowsElsewhere) {
  WalkedTake take(3, 1, [](std::vector<SeenPeople>& people) {
    for (std::size_t k = 20; k < 30; ++k) people[1][k][0][Landmark::kLeftWrist].pixel += glm::dvec2(90, 60);
  });
  ASSERT_TRUE(take.Adjust());
  double worst = 0;
  for (std::size_t k = 20; k < 30; ++k) {
    const LandmarkPositions truth = Walker(0, 0, static_cast<double>(k) / kTakeRate);
    worst = std::max(worst,
                     glm::distance(take.person.motion.poses[k][Role::kLeftWrist], *truth[Index(Landmark::kLeftWrist)]));
  }
  EXPECT_LT(worst, 0.02);
}

TEST(KeypointErrorPx, IsTheErrorThatKeypointsHave) {
  for (const std::size_t cameras : {2u, 4u}) {
    const WalkedTake take(cameras, 3);
    EXPECT_NEAR(KeypointErrorPx(take.cameras, take.person.people[0], 0.1, 1e3), 3, 0.3) << cameras;
  }
  const WalkedTake exact(2, 0);
  EXPECT_DOUBLE_EQ(KeypointErrorPx(exact.cameras, exact.person.people[0], 0.1, 1e3), 0.1);
}

}  // namespace
}  // namespace etude
