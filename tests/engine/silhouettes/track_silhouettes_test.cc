#include "engine/silhouettes/track_silhouettes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

#include "engine/silhouettes/turns.h"
#include "tests/engine/silhouettes/capsule_picture.h"

namespace etude {
namespace {

// An arm that swings, facing half to the left.
TreeState Swinging(const SilhouetteBody& body, double phase) {
  TreeState state = StandingState(body.tree);
  for (std::size_t i = 0; i < state.angles.size(); ++i) state.angles[i] = body.habits[i].angle;
  const auto set = [&](int joint, int axis, double degrees) {
    state.angles[body.tree.joints[joint].first_dof + axis] = Radians(degrees);
  };
  set(body.limbs[0].upper, 1, -60);
  set(body.limbs[1].upper, 0, 60 + 40 * std::sin(phase));
  set(body.limbs[1].lower, 0, 60);
  set(body.limbs[2].upper, 0, 35);
  set(body.limbs[2].lower, 0, -50);
  state.root_position = {0, 0.95, 0};
  state.root_frame = RotationBy({0, 0.6, 0}) * state.root_frame;
  return state;
}

struct Take {
  SilhouetteBody body = MakeSilhouetteBody({});
  std::vector<ProjectionMatrix> matrices;
  std::vector<std::vector<Silhouette>> silhouettes;
  std::vector<TreeState> truth;

  explicit Take(int frames, double thickness = 1) {
    for (int k = 0; k < frames; ++k) truth.push_back(Swinging(body, 0.4 * k));
    for (const Camera& camera : CamerasAround({-40, 40, 150})) {
      matrices.push_back(MatrixOf(camera));
      std::vector<Silhouette>& made = silhouettes.emplace_back();
      for (const TreeState& state : truth) {
        made.push_back(MakeSilhouette(RayCast(body, state, camera, thickness), {.spacing = 2}));
      }
    }
  }

  double MeanErrorOf(const SilhouetteTrack& track) const {
    double sum = 0;
    for (std::size_t k = 0; k < truth.size(); ++k) {
      const BodyPose found = ToBodyPose(track.body, track.frames[k]->state), wanted = ToBodyPose(body, truth[k]);
      for (const Role role : AllRoles()) sum += glm::distance(found[role], wanted[role]);
    }
    return sum / static_cast<double>(kRoleCount * truth.size());
  }
};

TrackOptions TrackInSmallPictures() {
  TrackOptions options;
  options.cost = {.sigma_px = 1, .outline_reach_px = 8, .inside_reach_px = 22};
  options.anchors = 2;
  return options;
}

TEST(TrackSilhouettes, FindsAndFollowsABodyThatNobodyHasShownIt) {
  const Take take(8);
  const SilhouetteTrack track =
      TrackSilhouettes(take.body, {take.matrices, take.silhouettes, std::nullopt}, TrackInSmallPictures());
  EXPECT_LT(take.MeanErrorOf(track), 0.03);
}

TEST(TrackSilhouettes, FindsOutHowThickThePersonIs) {
  const Take take(6, 1.15);
  TrackOptions options = TrackInSmallPictures();
  const SilhouetteTake seen{take.matrices, take.silhouettes, take.truth[0]};
  const SilhouetteTrack fitted = TrackSilhouettes(take.body, seen, options);
  options.thickness_passes = 0;
  const SilhouetteTrack average = TrackSilhouettes(take.body, seen, options);
  const auto mean_radius = [](const SilhouetteBody& body) {
    double sum = 0;
    for (const FleshCapsule& flesh : body.flesh) sum += flesh.radius_a;
    return sum;
  };
  EXPECT_NEAR(mean_radius(fitted.body) / mean_radius(take.body), 1.15, 0.05);
  EXPECT_EQ(mean_radius(average.body), mean_radius(take.body));
  EXPECT_LT(take.MeanErrorOf(fitted), take.MeanErrorOf(average) + 0.002);
}

TEST(TrackSilhouettes, LeavesFramesEmptyThatShowNobody) {
  Take take(5);
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
  Take take(2);
  for (auto& of_camera : take.silhouettes) {
    for (Silhouette& silhouette : of_camera) silhouette = MakeSilhouette(Mask(240, 180));
  }
  const SilhouetteTrack track =
      TrackSilhouettes(take.body, {take.matrices, take.silhouettes, std::nullopt}, TrackInSmallPictures());
  EXPECT_FALSE(track.frames[0] || track.frames[1]);
}

}  // namespace
}  // namespace etude
