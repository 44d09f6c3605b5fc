#pragma once

#include <cmath>
#include <vector>

#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/instant_fitter.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/turns.h"
#include "tests/engine/silhouettes/capsule_picture.h"

namespace etude {

// Returns a state with one swinging arm, facing half to the left.
inline TreeState Swinging(const SilhouetteBody& body, double phase) {
  TreeState state = Bent(body, {{body.limbs[0].upper, 1, -60},
                                {body.limbs[1].upper, 0, 60 + 40 * std::sin(phase)},
                                {body.limbs[1].lower, 0, 60},
                                {body.limbs[2].upper, 0, 35},
                                {body.limbs[2].lower, 0, -50}});
  state.root_position = {0, 0.95, 0};
  state.root_frame = RotationBy({0, 0.6, 0}) * state.root_frame;
  return state;
}

/// The silhouettes of the swinging body in three cameras.
struct SwingingTake {
  SilhouetteBody body = MakeSilhouetteBody({});
  std::vector<ProjectionMatrix> matrices;
  std::vector<std::vector<Silhouette>> silhouettes;
  std::vector<TreeState> truth;

  explicit SwingingTake(int frames, double thickness = 1) {
    for (int k = 0; k < frames; ++k) truth.push_back(Swinging(body, 0.4 * k));
    for (const Camera& camera : CamerasAround({-40, 40, 150})) {
      matrices.push_back(MatrixOf(camera));
      std::vector<Silhouette>& made = silhouettes.emplace_back();
      for (const TreeState& state : truth) {
        made.push_back(MakeSilhouette(RayCast(body, state, camera, thickness), {.spacing = 2}));
      }
    }
  }

  double MeanErrorOf(std::size_t frame, const TreeState& found) const {
    const BodyPose pose = ToBodyPose(body, found), wanted = ToBodyPose(body, truth[frame]);
    double sum = 0;
    for (const Role role : AllRoles()) sum += glm::distance(pose[role], wanted[role]);
    return sum / static_cast<double>(kRoleCount);
  }
};

/// Returns the mean error over frames, all of which must be found; `state_of(k)` is the k-th found state.
template <typename StateOf>
double MeanErrorOver(const SwingingTake& take, const StateOf& state_of) {
  double sum = 0;
  for (std::size_t k = 0; k < take.truth.size(); ++k) sum += take.MeanErrorOf(k, state_of(k));
  return sum / static_cast<double>(take.truth.size());
}

inline double SumOfRadii(const SilhouetteBody& body) {
  double sum = 0;
  for (const FleshCapsule& flesh : body.flesh) sum += flesh.radius_a;
  return sum;
}

inline TrackOptions TrackInSmallPictures() {
  TrackOptions options;
  options.cost = {.sigma_px = 1, .outline_reach_px = 8, .inside_reach_px = 22};
  options.anchors = 2;
  return options;
}

}  // namespace etude
