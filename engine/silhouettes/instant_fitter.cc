#include "engine/silhouettes/instant_fitter.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "engine/base/angles.h"
#include "engine/cameras/triangulation.h"
#include "engine/silhouettes/lost_limbs.h"
#include "engine/silhouettes/turns.h"

namespace etude {
namespace {

constexpr double kSpreadOfPeople = 0.15;  // standard deviation of people's thickness, as a share of the average
constexpr double kMaxChange = 0.15;       // largest relative change of a part's thickness in one pass

// A search uses losses with a wider reach than the final fit, and fewer iterations.
constexpr double kWideReach = 3;  // factor on every reach in SilhouetteCostOptions
constexpr int kCoarseSteps = 8, kFineSteps = 12;
constexpr double kSpeedKept = 0.6;  // share of the last change that is extrapolated to the next frame

// Returns the point triangulated from the silhouettes' centres; nullopt if the triangulation fails.
std::optional<glm::dvec3> FindMiddle(const MomentViews& views) {
  std::vector<Sighting> sightings;
  for (const SilhouetteView& view : views) sightings.push_back({view.matrix, view.silhouette->centre});
  const TriangulatedPoint middle = Triangulate(sightings);
  if (middle.status != PointStatus::kOk) return std::nullopt;
  return middle.position;
}

}  // namespace

ThicknessEstimate::ThicknessEstimate(const SilhouetteBody& body)
    : body_(body), products_(body.part_count, 0.0), squares_(body.part_count, 0.0) {}

void ThicknessEstimate::Add(std::span<const SilhouetteView> views, const TreeState& state,
                            const SilhouetteCostOptions& options, FitWorkspace& workspace) {
  ComputeFrames(body_.tree, state, workspace.frames);
  SeenFlesh& flesh = workspace.flesh.empty() ? workspace.flesh.emplace_back() : workspace.flesh.front();
  for (const SilhouetteView& view : views) {
    ProjectFlesh(body_, workspace.frames, view.matrix, flesh.capsules);
    MeasureFlesh(*view.silhouette, flesh);
    workspace.residuals.clear();
    AppendResiduals(flesh, *view.silhouette, options, workspace.residuals);
    for (const SilhouetteResidual& residual : workspace.residuals) {
      if (residual.is_inside) continue;
      const ProjectedCapsule& capsule = flesh.capsules[residual.capsule];
      const double radius = -residual.slopes[2] * capsule.radius_a - residual.slopes[5] * capsule.radius_b;
      const double weight = LossOf(residual, options).weight;
      const int part = body_.flesh[residual.capsule].part;
      products_[part] += weight * radius * residual.value;
      squares_[part] += weight * radius * radius;
    }
  }
}

SilhouetteBody ThicknessEstimate::Apply() const {
  SilhouetteBody body = body_;
  for (FleshCapsule& capsule : body.flesh) {
    const double share = products_[capsule.part] / (squares_[capsule.part] + 1 / (kSpreadOfPeople * kSpreadOfPeople));
    const double scale = 1 + std::clamp(share, -kMaxChange, kMaxChange);
    capsule.radius_a *= scale;
    capsule.radius_b *= scale;
  }
  return body;
}

InstantFitter::InstantFitter(const SilhouetteBody& body, const TrackOptions& options) : body_(body), options_(options) {
  wide_ = {.cost = options.cost, .max_iterations = kCoarseSteps};
  wide_.cost.outline_reach_px *= kWideReach;
  wide_.cost.inside_reach_px *= kWideReach;
  wide_.cost.joint_reach *= kWideReach;
  fine_ = {.cost = options.cost, .max_iterations = kFineSteps};
}

PosePrior InstantFitter::PriorNear(const TreeState& state) const {
  return {state, options_.position_change_m, options_.angle_change, options_.angle_change};
}

SilhouetteFit InstantFitter::Fit(const MomentViews& views, const TreeState& start, const PosePrior* prior,
                                 bool is_far) {
  if (!is_far) return FitSilhouettes(body_, views, start, prior, fine_, workspace_);
  const TreeState from = FitSilhouettes(body_, views, start, prior, wide_, workspace_).state;
  return FitFurther(body_, views, from, prior, fine_, workspace_);
}

SilhouetteFit InstantFitter::FitKnown(const MomentViews& views, const TreeState& start) {
  const PosePrior prior{start, options_.start_position_m, options_.start_angle, options_.start_angle};
  return Fit(views, start, &prior, true);
}

SilhouetteFit InstantFitter::Follow(const MomentViews& views, const TreeState& before_last, const TreeState& last) {
  const TreeState foretold = Extrapolated(before_last, last, kSpeedKept);
  const PosePrior prior = PriorNear(foretold);
  // Start from the pose of lower cost; the workspace keeps its projected capsules for the fit.
  const double moving = CostOf(body_, views, foretold, &prior, wide_.cost, workspace_).cost;
  std::swap(workspace_.flesh, workspace_.kept);
  const bool still = CostOf(body_, views, last, &prior, wide_.cost, workspace_, moving).cost < moving;
  if (still) std::swap(workspace_.flesh, workspace_.kept);
  const TreeState from = FitFurther(body_, views, still ? last : foretold, &prior, wide_, workspace_).state;
  return FitFurther(body_, views, from, &prior, fine_, workspace_);
}

// Fits the body from every heading and posture, starting at the point triangulated from the silhouettes' centres.
// Returns the fits by ascending cost.
std::vector<SilhouetteFit> InstantFitter::Guesses(const MomentViews& views) {
  constexpr int kHeadings = 8;
  std::vector<SilhouetteFit> fits;
  const std::optional<glm::dvec3> middle = FindMiddle(views);
  if (!middle) return fits;
  for (int i = 0; i < kHeadings; ++i) {
    for (TreeState start : Postures(body_)) {
      start.root_position = *middle;
      start.root_frame = RotationBy({0, 2 * kPi * i / kHeadings, 0}) * start.root_frame;
      fits.push_back(FitSilhouettes(body_, views, start, nullptr, wide_, workspace_));
    }
  }
  std::ranges::stable_sort(fits, {}, &SilhouetteFit::cost);
  return fits;
}

std::vector<SilhouetteFit> InstantFitter::Find(const MomentViews& views) {
  constexpr double kAnotherWay = Radians(100);
  constexpr std::size_t kMaxPoses = 3;
  std::vector<SilhouetteFit> found;
  for (const SilhouetteFit& guess : Guesses(views)) {
    const bool is_new = std::ranges::all_of(found, [&](const SilhouetteFit& other) {
      return glm::length(TurnOf(guess.state.root_frame * glm::transpose(other.state.root_frame))) > kAnotherWay;
    });
    if (!is_new) continue;
    found.push_back(WithLimbsFound(views, Fit(views, guess.state, nullptr, false), nullptr));
    if (found.size() == kMaxPoses) break;
  }
  return found;
}

SilhouetteFit InstantFitter::WithLimbsFound(const MomentViews& views, const SilhouetteFit& fit,
                                            const PosePrior* prior) {
  SilhouetteFit best = fit;
  for (const SilhouetteBody::Limb& limb : body_.limbs) {
    for (const TreeState& start : LimbCandidates(body_, views, best.state, limb, wide_.cost)) {
      SilhouetteFit trial = Fit(views, start, prior, false);
      if (trial.cost < best.cost) best = std::move(trial);
    }
  }
  return best;
}

}  // namespace etude
