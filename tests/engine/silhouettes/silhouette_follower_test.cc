#include "engine/silhouettes/silhouette_follower.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/engine/silhouettes/swinging_take.h"

namespace etude {
namespace {

std::vector<Silhouette> Moment(const SwingingTake& take, std::size_t frame) {
  std::vector<Silhouette> moment;
  for (const auto& of_camera : take.silhouettes) moment.push_back(of_camera[frame]);
  return moment;
}

std::vector<std::optional<SilhouetteFit>> Follow(const SwingingTake& take, SilhouetteFollower& follower) {
  std::vector<std::optional<SilhouetteFit>> told;
  for (std::size_t k = 0; k < take.truth.size(); ++k) told.push_back(follower.Next(Moment(take, k)));
  return told;
}

double MeanErrorOf(const SwingingTake& take, const std::vector<std::optional<SilhouetteFit>>& told) {
  return MeanErrorOver(take, [&](std::size_t k) { return told[k]->state; });
}

TEST(SilhouetteFollower, FollowsABodyFromAKnownStartAndFindsOneFromNone) {
  const SwingingTake take(10);
  SilhouetteFollower known(take.body, take.matrices, take.truth[0], TrackInSmallPictures());
  EXPECT_LT(MeanErrorOf(take, Follow(take, known)), 0.03);
  SilhouetteFollower cold(take.body, take.matrices, std::nullopt, TrackInSmallPictures());
  const auto told = Follow(take, cold);
  EXPECT_LT(take.MeanErrorOf(9, told[9]->state), 0.04) << "after its trial";
}

TEST(SilhouetteFollower, IsLostWhereCamerasAreConfused) {
  SwingingTake take(4);
  std::swap(take.silhouettes[0], take.silhouettes[1]);
  SilhouetteFollower follower(take.body, take.matrices, take.truth[0], TrackInSmallPictures());
  EXPECT_GT(MeanErrorOf(take, Follow(take, follower)), 0.04) << "the control";
}

TEST(SilhouetteFollower, FindsOutHowThickThePersonIs) {
  const SwingingTake take(22, 1.15);
  TrackOptions options = TrackInSmallPictures();
  SilhouetteFollower fitted(take.body, take.matrices, take.truth[0], options);
  Follow(take, fitted);
  EXPECT_NEAR(SumOfRadii(fitted.body()) / SumOfRadii(take.body), 1.15, 0.06);
  options.thickness_passes = 0;
  SilhouetteFollower average(take.body, take.matrices, take.truth[0], options);
  Follow(take, average);
  EXPECT_EQ(SumOfRadii(average.body()), SumOfRadii(take.body));
}

TEST(SilhouetteFollower, TellsNothingWhereNobodyIsShownAndGoesOnAfterwards) {
  SwingingTake take(5);
  for (auto& of_camera : take.silhouettes) of_camera[0] = of_camera[3] = MakeSilhouette(Mask(240, 180));
  take.silhouettes[0][2] = take.silhouettes[1][2] = MakeSilhouette(Mask(240, 180));
  SilhouetteFollower follower(take.body, take.matrices, take.truth[1], TrackInSmallPictures());
  const auto told = Follow(take, follower);
  EXPECT_FALSE(told[0]) << "no picture shows anybody";
  EXPECT_TRUE(told[1]);
  EXPECT_FALSE(told[2]) << "one picture is not enough";
  EXPECT_FALSE(told[3]);
  ASSERT_TRUE(told[4]);
  EXPECT_LT(take.MeanErrorOf(4, told[4]->state), 0.06);
}

TEST(SilhouetteFollower, FindsNobodyWhereLinesOfSightAreOne) {
  const SwingingTake take(1);
  const std::vector<ProjectionMatrix> same(2, take.matrices[0]);
  SilhouetteFollower nowhere(take.body, same, std::nullopt, TrackInSmallPictures());
  EXPECT_FALSE(nowhere.Next(std::vector<Silhouette>(2, take.silhouettes[0][0])));
}

}  // namespace
}  // namespace etude
