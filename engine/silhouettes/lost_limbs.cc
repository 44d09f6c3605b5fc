#include "engine/silhouettes/lost_limbs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "engine/base/angles.h"

namespace etude {
namespace {

// Returns the angle at the given share of a degree of freedom's range.
double InRange(const KinematicTree& tree, int dof, double share) {
  return std::lerp(tree.limits[dof].lower, tree.limits[dof].upper, share);
}

// Sets the first angle of both shoulders (or hips) to `upper`, and the first angle of both elbows (or knees) to
// `lower`.
void Bend(const SilhouetteBody& body, bool arms, double upper, double lower, TreeState& state) {
  for (const SilhouetteBody::Limb& limb : body.limbs) {
    if (limb.is_arm != arms) continue;
    state.angles[body.tree.joints[limb.upper].first_dof] = upper;
    state.angles[body.tree.joints[limb.lower].first_dof] = lower;
  }
}

// Returns true if `joint` is `ancestor` or a descendant of `ancestor`.
bool MovesWith(const KinematicTree& tree, int joint, int ancestor) {
  while (joint > ancestor) joint = tree.joints[joint].parent;
  return joint == ancestor;
}

// Computes the cost of a pose in which only one limb differs from a given pose.
class LimbCost {
 public:
  LimbCost(const SilhouetteBody& body, std::span<const SilhouetteView> views, const TreeState& state, int upper,
           const SilhouetteCostOptions& options)
      : views_(views), options_(options), limb_(body) {
    SilhouetteBody rest = body;
    const auto is_limb = [&](const FleshCapsule& flesh) { return MovesWith(body.tree, flesh.a.joint, upper); };
    std::erase_if(rest.flesh, is_limb);
    std::erase_if(limb_.flesh, [&](const FleshCapsule& flesh) { return !is_limb(flesh); });
    ComputeFrames(body.tree, state, frames_);
    for (const SilhouetteView& view : views) {
      ProjectFlesh(rest, frames_, view.matrix, flesh_);
      std::vector<double>& distances = to_rest_.emplace_back(view.silhouette->columns.u.size(), kFar);
      OutlineDistances(flesh_, *view.silhouette, distances);
    }
  }

  // Returns the cost. As soon as the cost reaches `limit`, returns infinity; this is safe because the cost is a sum of
  // losses ≥ 0.
  double Of(const TreeState& state, double limit) {
    double cost = 0;
    ComputeFrames(limb_.tree, state, frames_);
    for (std::size_t i = 0; i < views_.size(); ++i) {
      ProjectFlesh(limb_, frames_, views_[i].matrix, flesh_);
      distances_ = to_rest_[i];
      OutlineDistances(flesh_, *views_[i].silhouette, distances_);
      for (const int place : views_[i].silhouette->columns.places) {
        cost += LossOf({.value = distances_[static_cast<std::size_t>(place)]}, options_).loss;
      }
      AddContainmentLosses(flesh_, *views_[i].silhouette, options_, cost);
      if (cost >= limit) return std::numeric_limits<double>::infinity();
    }
    return cost;
  }

 private:
  static constexpr double kFar = 1e4;  // larger than any distance in a picture, pixels

  const std::span<const SilhouetteView> views_;
  const SilhouetteCostOptions& options_;
  SilhouetteBody limb_;                       // the body with this limb's capsules only
  std::vector<std::vector<double>> to_rest_;  // [view][outline column]: distance to the other limbs' capsules, pixels
  TreeFrames frames_;
  std::vector<ProjectedCapsule> flesh_;
  std::vector<double> distances_;
};

struct Candidate {
  TreeState state;
  double cost = 0;
};

}  // namespace

std::vector<TreeState> Postures(const SilhouetteBody& body) {
  TreeState standing = StandingState(body.tree);
  for (std::size_t i = 0; i < standing.angles.size(); ++i) standing.angles[i] = body.habits[i].angle;
  TreeState raised = standing, crouching = standing;
  Bend(body, true, Radians(120), Radians(30), raised);
  Bend(body, false, Radians(60), Radians(-80), crouching);
  return {standing, raised, crouching};
}

std::vector<TreeState> LimbCandidates(const SilhouetteBody& body, std::span<const SilhouetteView> views,
                                      const TreeState& state, const SilhouetteBody::Limb& limb,
                                      const SilhouetteCostOptions& options) {
  constexpr std::size_t kKept = 2;
  constexpr int kForward = 6, kSideways = 4, kTwist = 3, kBend = 3;
  const int upper = body.tree.joints[limb.upper].first_dof, lower = body.tree.joints[limb.lower].first_dof;
  LimbCost cost(body, views, state, limb.upper, options);
  std::vector<Candidate> best;
  TreeState trial = state;
  // Try the middle of every cell of the grid, and keep the limb positions with the lowest costs, in ascending order.
  const auto share = [](int i, int count) { return (i + 0.5) / count; };
  for (int x = 0; x < kForward; ++x) {
    trial.angles[upper] = InRange(body.tree, upper, share(x, kForward));
    for (int y = 0; y < kSideways; ++y) {
      trial.angles[upper + 1] = InRange(body.tree, upper + 1, share(y, kSideways));
      for (int z = 0; z < kTwist; ++z) {
        trial.angles[upper + 2] = InRange(body.tree, upper + 2, share(z, kTwist));
        for (int b = 0; b < kBend; ++b) {
          trial.angles[lower] = InRange(body.tree, lower, share(b, kBend));
          const double limit = best.size() < kKept ? std::numeric_limits<double>::infinity() : best.back().cost;
          const double trial_cost = cost.Of(trial, limit);
          if (best.size() == kKept && trial_cost >= limit) continue;
          best.push_back({trial, trial_cost});
          std::ranges::inplace_merge(best, best.end() - 1, {}, &Candidate::cost);
          if (best.size() > kKept) best.pop_back();
        }
      }
    }
  }
  std::vector<TreeState> places;
  for (Candidate& place : best) places.push_back(std::move(place.state));
  return places;
}

}  // namespace etude
