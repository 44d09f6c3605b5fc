#include "engine/silhouettes/turns.h"

#include <gtest/gtest.h>

#include <glm/gtc/quaternion.hpp>
#include <vector>

#include "engine/silhouettes/lost_limbs.h"
#include "tests/engine/silhouettes/swinging_take.h"

namespace etude {
namespace {

double FurthestColumn(const glm::dmat3& a, const glm::dmat3& b) {
  double furthest = 0;
  for (int i = 0; i < 3; ++i) furthest = std::max(furthest, glm::distance(a[i], b[i]));
  return furthest;
}

TEST(Turns, AreThoseOfQuaternions) {
  EXPECT_EQ(RotationBy({0, 0, 0}), glm::dmat3(1));
  for (const glm::dvec3 turn : {glm::dvec3(0.3, 0, 0), glm::dvec3(0, -2.9, 0), glm::dvec3(0.4, 1.1, -0.7)}) {
    const double angle = glm::length(turn);
    EXPECT_LT(FurthestColumn(RotationBy(turn), glm::mat3_cast(glm::angleAxis(angle, turn / angle))), 1e-12);
    EXPECT_LT(glm::distance(TurnOf(RotationBy(turn)), turn), 1e-9);
  }
}

TEST(Turns, MovedAddsToEveryCoordinateWithinTheLimits) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const TreeState state = Swinging(body, 0.3);
  std::vector<double> by(kRootDofs + state.angles.size(), 0.05);
  by[3] = 0, by[4] = 0.5, by[5] = 0;
  by[kRootDofs + 2] = 100;
  const TreeState moved = Moved(body.tree, state, by);
  EXPECT_LT(glm::distance(moved.root_position, state.root_position + glm::dvec3(0.05)), 1e-15);
  EXPECT_LT(FurthestColumn(moved.root_frame, RotationBy({0, 0.5, 0}) * state.root_frame), 1e-15);
  for (std::size_t i = 0; i < state.angles.size(); ++i) {
    const double wanted =
        i == 2 ? body.tree.limits[i].upper : std::min(state.angles[i] + 0.05, body.tree.limits[i].upper);
    EXPECT_DOUBLE_EQ(moved.angles[i], wanted) << i;
  }
}

TEST(Turns, MeansAreHalfWayAndEvenMotionGoesOnEvenly) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  TreeState before = Swinging(body, 0.3), last = before;
  const glm::dvec3 turn(0.2, -0.5, 0.1), step(0.1, 0, -0.3);
  last.root_position += step;
  last.root_frame = RotationBy(turn) * before.root_frame;
  for (double& angle : last.angles) angle += 0.2;
  const TreeState mean = MeanState(before, last), next = Extrapolated(before, last, 1.5);
  const auto expect = [&](const TreeState& state, double share) {
    EXPECT_LT(glm::distance(state.root_position, before.root_position + share * step), 1e-12) << share;
    EXPECT_LT(FurthestColumn(state.root_frame, RotationBy(share * turn) * before.root_frame), 1e-12) << share;
    for (std::size_t i = 0; i < state.angles.size(); ++i) {
      EXPECT_NEAR(state.angles[i], before.angles[i] + 0.2 * share, 1e-12) << share;
    }
  };
  expect(mean, 0.5);
  expect(next, 2.5);
}

TEST(Postures, HaveArmsThatHangArmsThatAreRaisedAndBentLegs) {
  const SilhouetteBody body = MakeSilhouetteBody({});
  const auto postures = Postures(body);
  ASSERT_EQ(postures.size(), 3u);
  for (std::size_t i = 0; i < postures[0].angles.size(); ++i) EXPECT_EQ(postures[0].angles[i], body.habits[i].angle);
  std::vector<BodyPose> poses;
  for (const TreeState& state : postures) poses.push_back(ToBodyPose(body, state));
  for (const auto& [hand, knee, ankle] : {std::tuple(Role::kLeftHand, Role::kLeftKnee, Role::kLeftAnkle),
                                          {Role::kRightHand, Role::kRightKnee, Role::kRightAnkle}}) {
    EXPECT_LT(poses[0][hand].y, poses[0][Role::kHipCentre].y + 0.05);
    EXPECT_GT(poses[1][hand].y, poses[1][Role::kHead].y);
    EXPECT_LT(glm::distance(poses[1][knee], poses[0][knee]), 1e-12) << "only arms are raised";
    EXPECT_LT(glm::distance(poses[2][hand], poses[0][hand]), 1e-12) << "only legs are bent";
    // The thigh is 60° forward, the shank 80° back from it.
    const glm::dvec3 thigh = poses[2][knee] - poses[2][knee == Role::kLeftKnee ? Role::kLeftHip : Role::kRightHip];
    const double shank = glm::distance(poses[2][knee], poses[2][ankle]);
    EXPECT_NEAR(thigh.z, glm::length(thigh) * std::sin(Radians(60)), 0.01);
    EXPECT_NEAR(poses[2][knee].y - poses[2][ankle].y, shank * std::cos(Radians(20)), 0.05);
  }
}

TEST(LimbCandidates, AnArmThatIsElsewhereIsFoundNearby) {
  const SwingingTake take(1);
  std::vector<SilhouetteView> views;
  for (std::size_t c = 0; c < take.matrices.size(); ++c) views.push_back({take.matrices[c], &take.silhouettes[c][0]});
  for (const std::size_t arm : {0u, 1u}) {
    const SilhouetteBody::Limb& limb = take.body.limbs[arm];
    TreeState lost = take.truth[0];
    for (const int joint : {limb.upper, limb.lower}) {
      const int first = take.body.tree.joints[joint].first_dof;
      for (int i = first; i < first + (joint == limb.upper ? 3 : 1); ++i) lost.angles[i] = take.body.habits[i].angle;
    }
    const auto places = LimbCandidates(take.body, views, lost, limb, TrackInSmallPictures().cost);
    ASSERT_FALSE(places.empty());
    ASSERT_LE(places.size(), 2u);
    const BodyPose truth = ToBodyPose(take.body, take.truth[0]), before = ToBodyPose(take.body, lost);
    const BodyPose best = ToBodyPose(take.body, places[0]);
    const Role wrist =
        glm::distance(truth[Role::kLeftWrist], before[Role::kLeftWrist]) > 0.01 ? Role::kLeftWrist : Role::kRightWrist;
    EXPECT_GT(glm::distance(before[wrist], truth[wrist]), 0.3) << "the control";
    EXPECT_LT(glm::distance(best[wrist], truth[wrist]), 0.15) << arm;
    for (const Role role : {Role::kHead, Role::kLeftFoot, Mirrored(wrist)}) {
      EXPECT_LT(glm::distance(best[role], before[role]), 1e-12) << "the rest stays";
    }
  }
}

TEST(SilhouetteLoss, IsGemanAndMcClures) {
  const SilhouetteCostOptions options{.sigma_px = 2, .outline_reach_px = 10, .inside_reach_px = 40, .inside_weight = 3};
  for (const double e : {-7.0, 0.5, 30.0}) {
    const Loss outline = LossOf({.value = e}, options), inside = LossOf({.value = e, .is_inside = true}, options);
    EXPECT_NEAR(outline.loss, e * e / (1 + e * e / 100) / 4, 1e-12);
    EXPECT_NEAR(inside.loss, 3 * e * e / (1 + e * e / 1600) / 4, 1e-12);
    // The weight is w = slope / (2 e), so that the squared error w e² has the slope of the loss.
    const double step = 1e-5;
    const auto slope = [&](bool is_inside) {
      return (LossOf({.value = e + step, .is_inside = is_inside}, options).loss -
              LossOf({.value = e - step, .is_inside = is_inside}, options).loss) /
             (2 * step);
    };
    EXPECT_NEAR(outline.weight, slope(false) / (2 * e), 1e-6);
    EXPECT_NEAR(inside.weight, slope(true) / (2 * e), 1e-6);
  }
}

}  // namespace
}  // namespace etude
