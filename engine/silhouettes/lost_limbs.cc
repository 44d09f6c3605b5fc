#include "engine/silhouettes/lost_limbs.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {
namespace {

// `share` of the way through the range of a degree of freedom.
double InRange(const KinematicTree& tree, int dof, double share) {
  return std::lerp(tree.limits[dof].lower, tree.limits[dof].upper, share);
}

// Turns every upper arm (or leg) so far forward, and its elbow (or knee) so far.
void Bend(const SilhouetteBody& body, bool arms, double upper, double lower, TreeState& state) {
  for (const SilhouetteBody::Limb& limb : body.limbs) {
    if (limb.is_arm != arms) continue;
    state.angles[body.tree.joints[limb.upper].first_dof] = upper;
    state.angles[body.tree.joints[limb.lower].first_dof] = lower;
  }
}

}  // namespace

std::vector<TreeState> Postures(const SilhouetteBody& body) {
  TreeState standing = StandingState(body.tree);
  for (std::size_t i = 0; i < standing.angles.size(); ++i) standing.angles[i] = body.habits[i].angle;
  TreeState raised = standing, crouching = standing;
  Bend(body, true, Radians(120), Radians(30), raised);
  Bend(body, false, Radians(60), Radians(-80), crouching);
  return {standing, raised, crouching};
}

std::vector<TreeState> LimbPlaces(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                  const TreeState& state, const SilhouetteBody::Limb& limb,
                                  const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  constexpr std::size_t kKept = 2;
  constexpr int kForward = 6, kSideways = 4, kTwist = 3, kBend = 3;
  const int upper = body.tree.joints[limb.upper].first_dof, lower = body.tree.joints[limb.lower].first_dof;
  std::vector<SilhouetteFit> best;
  TreeState trial = state;
  const auto share = [](int i, int count) { return (i + 0.5) / count; };
  for (int x = 0; x < kForward; ++x) {
    trial.angles[upper] = InRange(body.tree, upper, share(x, kForward));
    for (int y = 0; y < kSideways; ++y) {
      trial.angles[upper + 1] = InRange(body.tree, upper + 1, share(y, kSideways));
      for (int z = 0; z < kTwist; ++z) {
        trial.angles[upper + 2] = InRange(body.tree, upper + 2, share(z, kTwist));
        for (int b = 0; b < kBend; ++b) {
          trial.angles[lower] = InRange(body.tree, lower, share(b, kBend));
          best.push_back(CostOf(body, views, trial, nullptr, options, workspace));
          std::ranges::inplace_merge(best, best.end() - 1, {}, &SilhouetteFit::cost);
          if (best.size() > kKept) best.pop_back();
        }
      }
    }
  }
  std::vector<TreeState> places;
  for (SilhouetteFit& fit : best) places.push_back(std::move(fit.state));
  return places;
}

}  // namespace etude
