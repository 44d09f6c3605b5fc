// The golden value of tracking by silhouettes: small pictures of a turning person, some cut off, some without a person.
// The other tests of this folder check that results are right.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/silhouette_follower.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "tests/engine/silhouettes/swinging_take.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddFit(Fingerprint& print, const std::optional<SilhouetteFit>& fit) {
  print.Add(fit.has_value());
  if (!fit) return;
  const TreeState& state = fit->state;
  print.Add(state.root_position).Add(state.root_frame[0]).Add(state.root_frame[1]).Add(state.angles);
  print.Add(1e-3 * fit->picture_cost).Add(1e-3 * fit->cost).Add(fit->iterations);
}

LimbLengths ShortLegged() {
  LimbLengths lengths;
  lengths.thigh *= 0.8, lengths.trunk *= 1.1, lengths.hand *= 1.2, lengths.foot *= 0.9, lengths.neck *= 1.3;
  return lengths;
}

/// Small pictures of a person who turns round and swings arms and legs; one camera is near, and one cuts off the feet.
struct TurningTake {
  SilhouetteBody body = MakeSilhouetteBody({});
  std::vector<ProjectionMatrix> matrices;
  std::vector<std::vector<Silhouette>> silhouettes;
  std::vector<TreeState> truth;
  std::vector<std::vector<std::vector<SeenJoint>>> joints;

  explicit TurningTake(int frames, double pace = 1) {
    const SilhouetteBody filmed = MakeSilhouetteBody(ShortLegged());
    for (int k = 0; k < frames; ++k) {
      TreeState state = Swinging(body, 0.5 * pace * k);
      state.root_frame = RotationBy({0, 0.15 * pace * k, 0.02 * k}) * state.root_frame;
      state.root_position += 0.03 * pace * k * glm::dvec3(1, 0, 0.3);
      state.angles[body.tree.joints[body.limbs[3].upper].first_dof] = 0.5 + 0.5 * std::cos(0.4 * k);
      truth.push_back(state);
    }
    const std::vector<double> angles = {-50, 30, 160};
    for (std::size_t c = 0; c < angles.size(); ++c) {
      const double away = c == 1 ? 2.6 : 3.6;
      const glm::dvec3 p_WC(away * std::sin(Radians(angles[c])), 1.1 + 0.4 * c, away * std::cos(Radians(angles[c])));
      const Camera camera =
          LookAt({.width = 91, .height = 70, .fx = 84, .fy = 88, .cx = 45, .cy = 33}, p_WC, glm::dvec3(0, 0.95, 0));
      matrices.push_back(MatrixOf(camera));
      silhouettes.emplace_back();
      joints.emplace_back();
      for (int k = 0; k < frames; ++k) {
        silhouettes[c].push_back(MakeSilhouette(RayCast(filmed, truth[k], camera, 1.1), {.spacing = 2}));
        const BodyPose pose = ToBodyPose(filmed, truth[k]);
        auto& seen = joints[c].emplace_back();
        for (const Role role : {Role::kHead, Role::kLeftElbow, Role::kRightWrist, Role::kLeftAnkle, Role::kRightKnee}) {
          const double off = (k + static_cast<int>(role)) % 4 == 0 ? 9 : 0.4;
          seen.push_back({role, *Project(matrices[c], pose[role]) + off, 1 + 0.2 * k});
        }
      }
    }
  }
};

TrackOptions OptionsOfSmallPictures() {
  TrackOptions options;
  options.cost = {.sigma_px = 1.5, .outline_reach_px = 5, .inside_reach_px = 12};
  return options;
}

TEST(SilhouetteFollower, FindsNobodyWhereLinesOfSightAreOne) {
  const TurningTake take(1);
  const std::vector<ProjectionMatrix> same(2, take.matrices[0]);
  SilhouetteFollower nowhere(take.body, same, std::nullopt, OptionsOfSmallPictures());
  EXPECT_FALSE(nowhere.Next(std::vector<Silhouette>(2, take.silhouettes[0][0])));
}

TEST(SilhouettesGolden, TracksOfWholeTakes) {
  Fingerprint print;
  for (const bool is_known : {true, false}) {
    TurningTake take(is_known ? 8 : 5, 1.5);
    TrackOptions options = OptionsOfSmallPictures();
    options.anchors = is_known ? 0 : 1;
    options.trial_frames = 2;
    options.lost = 1.2;
    if (is_known) options.repairs = 1, options.thickness_passes = 1;
    take.silhouettes[0][2] = take.silhouettes[1][2] = MakeSilhouette(Mask(91, 70));
    take.silhouettes[2][4] = take.silhouettes[2][1];
    if (is_known) take.silhouettes[2][5] = take.silhouettes[2][6] = take.silhouettes[1][6] = take.silhouettes[2][1];
    const SilhouetteTrack track =
        TrackSilhouettes(take.body,
                         {take.matrices, take.silhouettes,
                          is_known ? std::optional(TurnedRound(take.body, take.truth[0])) : std::nullopt,
                          is_known ? std::span(take.joints) : std::span<std::vector<std::vector<SeenJoint>>>()},
                         options);
    for (const FleshCapsule& flesh : track.body.flesh) print.Add(flesh.radius_a).Add(flesh.radius_b);
    for (const auto& fit : track.frames) AddFit(print, fit);
  }
  EXPECT_TRUE(print.Is(675, -12.6493808932));
}

}  // namespace
}  // namespace etude
