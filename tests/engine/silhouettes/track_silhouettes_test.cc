#include "engine/silhouettes/track_silhouettes.h"

#include <gtest/gtest.h>

#include "engine/silhouettes/fit_joints.h"
#include "tests/engine/silhouettes/swinging_take.h"

namespace etude {
namespace {

double MeanErrorOf(const SwingingTake& take, const SilhouetteTrack& track) {
  return MeanErrorOver(take, [&](std::size_t k) { return track.frames[k]->state; });
}

TEST(TrackSilhouettes, FindsAndFollowsABodyThatNobodyHasShownIt) {
  const SwingingTake take(8);
  const SilhouetteTrack track =
      TrackSilhouettes(take.body, {take.matrices, take.silhouettes, std::nullopt}, TrackInSmallPictures());
  EXPECT_LT(MeanErrorOf(take, track), 0.03);
}

// The control: tracking alone, from the turned start, keeps the body turned.
TEST(TrackSilhouettes, TurnsABodyRoundThatFacesTheWrongWay) {
  const SwingingTake take(8);
  TrackOptions options = TrackInSmallPictures();
  options.anchors = 0;
  const TreeState turned = TurnedRound(take.body, take.truth[0]);
  const SilhouetteTrack track = TrackSilhouettes(take.body, {take.matrices, take.silhouettes, turned}, options);
  EXPECT_GT(take.MeanErrorOf(0, turned), 0.1);
  EXPECT_LT(MeanErrorOf(take, track), 0.03);
}

TEST(TurnedRound, ExchangesLeftAndRightWhereLimbsStayAndLooksBack) {
  const SwingingTake take(4);
  for (const TreeState& state : take.truth) {
    const TreeState turned = TurnedRound(take.body, state);
    const BodyPose before = ToBodyPose(take.body, state), after = ToBodyPose(take.body, turned);
    double off = 0;
    for (const Role role : {Role::kLeftHand, Role::kRightHand, Role::kLeftElbow, Role::kRightKnee, Role::kLeftAnkle}) {
      off += glm::distance(after[role], before[Mirrored(role)]) / 5;
    }
    EXPECT_LT(off, 0.08);
    EXPECT_LT(glm::dot(Facing(before), Facing(after)), -0.5);
    for (std::size_t i = 0; i < turned.angles.size(); ++i) {
      EXPECT_GE(turned.angles[i], take.body.tree.limits[i].lower - 1e-9);
      EXPECT_LE(turned.angles[i], take.body.tree.limits[i].upper + 1e-9);
    }
  }
}

TEST(TrackSilhouettes, FindsOutHowThickThePersonIs) {
  const SwingingTake take(6, 1.15);
  TrackOptions options = TrackInSmallPictures();
  const SilhouetteTake seen{take.matrices, take.silhouettes, take.truth[0]};
  const SilhouetteTrack fitted = TrackSilhouettes(take.body, seen, options);
  options.thickness_passes = 0;
  const SilhouetteTrack average = TrackSilhouettes(take.body, seen, options);
  EXPECT_NEAR(SumOfRadii(fitted.body) / SumOfRadii(take.body), 1.15, 0.05);
  EXPECT_EQ(SumOfRadii(average.body), SumOfRadii(take.body));
  EXPECT_LT(MeanErrorOf(take, fitted), MeanErrorOf(take, average) + 0.002);
}

TEST(TrackSilhouettes, LeavesFramesEmptyThatShowNobody) {
  SwingingTake take(5);
  for (auto& of_camera : take.silhouettes) of_camera[2] = MakeSilhouette(Mask(240, 180));
  take.silhouettes[0][4] = take.silhouettes[1][4] = MakeSilhouette(Mask(240, 180));
  const SilhouetteTrack track =
      TrackSilhouettes(take.body, {take.matrices, take.silhouettes, take.truth[0]}, TrackInSmallPictures());
  EXPECT_TRUE(track.frames[1]);
  EXPECT_FALSE(track.frames[2]) << "no picture shows anybody";
  EXPECT_TRUE(track.frames[3]);
  EXPECT_FALSE(track.frames[4]) << "one picture is not enough";
}

TEST(TrackSilhouettes, OfNobodyIsEmpty) {
  SwingingTake take(2);
  for (auto& of_camera : take.silhouettes) {
    for (Silhouette& silhouette : of_camera) silhouette = MakeSilhouette(Mask(240, 180));
  }
  const SilhouetteTrack track =
      TrackSilhouettes(take.body, {take.matrices, take.silhouettes, std::nullopt}, TrackInSmallPictures());
  EXPECT_FALSE(track.frames[0] || track.frames[1]);
}

}  // namespace
}  // namespace etude
