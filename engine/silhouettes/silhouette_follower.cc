#include "engine/silhouettes/silhouette_follower.h"

#include <algorithm>
#include <cassert>

namespace etude {
namespace {

constexpr int kSearchEvery = 5;           // moments between searches; a search takes as long as dozens of moments
constexpr std::size_t kRemembered = 100;  // number of moments from which the usual cost is estimated
constexpr int kThicknessMoments = 20;     // number of moments from which each estimate of the thickness is made

}  // namespace

SilhouetteFollower::SilhouetteFollower(const SilhouetteBody& body, std::span<const ProjectionMatrix> cameras,
                                       const std::optional<TreeState>& start, const TrackOptions& options)
    : options_(options), body_(body), cameras_(cameras.begin(), cameras.end()), start_(start) {
  assert(cameras.size() >= 2);
}

void SilhouetteFollower::Begin(const MomentViews& views) {
  if (start_) {
    const SilhouetteFit fit = fitter_.FitKnown(views, *start_);
    paths_.push_back({fit, fit.state, fit.picture_cost});
    return;
  }
  for (const SilhouetteFit& fit : fitter_.Find(views)) paths_.push_back({fit, fit.state, fit.picture_cost});
}

// Returns true if the cost of `fit` far exceeds the usual cost of a body without a lost limb: the 20th percentile over
// the last moments.
bool SilhouetteFollower::IsLost(const SilhouetteFit& fit) const {
  constexpr std::size_t kEnough = 10;
  if (costs_.size() < kEnough) return false;
  std::vector<double> costs = costs_;
  const auto usual = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 5);
  std::ranges::nth_element(costs, usual);
  return fit.picture_cost > options_.lost * *usual;
}

void SilhouetteFollower::Follow(const MomentViews& views, Path& path) {
  const TreeState last = path.fit.state;
  path.fit = fitter_.Follow(views, path.before, last);
  if (IsLost(path.fit) && since_search_ >= kSearchEvery) {
    path.fit = fitter_.WithLimbsFound(views, path.fit, nullptr);
    since_search_ = 0;
  }
  path.before = last;
  path.cost += path.fit.picture_cost;
}

void SilhouetteFollower::Learn(const MomentViews& views) {
  if (thickness_passes_ == options_.thickness_passes) return;
  if (!thickness_) thickness_.emplace(body_);
  thickness_->Add(views, paths_.front().fit.state, options_.cost, fitter_.workspace());
  if (++thickness_moments_ < kThicknessMoments) return;
  body_ = thickness_->Apply();
  thickness_.reset();
  thickness_moments_ = 0;
  ++thickness_passes_;
}

std::optional<SilhouetteFit> SilhouetteFollower::Next(std::span<const Silhouette> silhouettes) {
  assert(silhouettes.size() == cameras_.size());
  MomentViews views;
  for (std::size_t c = 0; c < cameras_.size(); ++c) {
    if (silhouettes[c].area > 0) views.push_back({cameras_[c], &silhouettes[c]});
  }
  if (views.size() < 2) return std::nullopt;
  // Start paths in the first moment that shows a person; later, follow each path to this moment.
  ++since_search_;
  if (paths_.empty()) {
    Begin(views);
  } else {
    for (Path& path : paths_) Follow(views, path);
  }
  if (paths_.empty()) return std::nullopt;
  // After the trial, keep only the path with the lowest cost.
  std::ranges::stable_sort(paths_, {}, &Path::cost);
  if (++moments_ >= options_.trial_frames) paths_.resize(1);
  costs_.push_back(paths_.front().fit.picture_cost);
  if (costs_.size() > kRemembered) costs_.erase(costs_.begin());
  const SilhouetteFit result = paths_.front().fit;
  if (paths_.size() == 1) Learn(views);
  return result;
}

}  // namespace etude
