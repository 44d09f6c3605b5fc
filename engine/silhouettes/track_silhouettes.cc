#include "engine/silhouettes/track_silhouettes.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>
#include <numeric>
#include <ranges>
#include <utility>

#include "engine/silhouettes/fit_joints.h"
#include "engine/silhouettes/instant_fitter.h"
#include "engine/silhouettes/turns.h"

namespace etude {
namespace {

using Fits = std::vector<std::optional<SilhouetteFit>>;

constexpr std::size_t kFollowedAnchors = 2;  // maximum number of start poses that are followed through the take
constexpr int kTurnedMoments = 5;            // number of frames in which the body turned front to back is searched for
constexpr double kClearlyBetter = 0.95;      // the turned body is taken if the ratio of costs is lower

double Squared(double x) { return x * x; }

// Returns the cost of the change between two poses: the sum of squared differences, each in units of its expected
// change.
double StepCost(const TreeState& a, const TreeState& b, const TrackOptions& options) {
  const glm::dvec3 moved = a.root_position - b.root_position;
  const glm::dvec3 turned = TurnOf(a.root_frame * glm::transpose(b.root_frame));
  double jump = glm::dot(moved, moved) / Squared(options.position_change_m) +
                glm::dot(turned, turned) / Squared(options.angle_change);
  for (std::size_t i = 0; i < a.angles.size(); ++i) {
    jump += Squared((a.angles[i] - b.angles[i]) / options.angle_change);
  }
  return jump;
}

class Tracker {
 public:
  Tracker(const SilhouetteBody& body, const SilhouetteTake& take, const TrackOptions& options)
      : body_(body), take_(take), options_(options), frame_count_(take.silhouettes[0].size()) {
    for (std::size_t k = 0; k < frame_count_; ++k) {
      MomentViews& views = views_.emplace_back();
      for (std::size_t c = 0; c < take.cameras.size(); ++c) {
        const Silhouette& silhouette = take.silhouettes[c][k];
        if (silhouette.area == 0) continue;
        views.push_back({take.cameras[c], &silhouette});
        if (!take.joints.empty()) views.back().joints = take.joints[c][k];
      }
    }
  }

  SilhouetteTrack Run() {
    // Follow the body from each start pose, in both directions of time, and combine the paths (`Better`).
    Fits fits(frame_count_);
    bool is_first = true;
    for (const Anchor& anchor : ChooseAnchors()) {
      Fits followed = FollowBothWays(anchor);
      followed = Better(followed, Retraced(followed));
      fits = is_first ? std::move(followed) : Better(fits, followed);
      is_first = false;
    }
    if (is_first) return {body_, std::move(fits)};
    // Track the body turned front to back, and keep it if its cost is clearly lower.
    fits = EitherWayRound(std::move(fits));
    // Estimate the thickness, and fit every frame again.
    for (int i = 0; i < options_.thickness_passes; ++i) {
      FitThickness(fits);
      Refit(fits);
    }
    // Search for lost limbs, then smooth.
    for (int i = 0; i < options_.repairs; ++i) {
      Repair(fits);
      Smooth(fits);
    }
    return {body_, std::move(fits)};
  }

 private:
  struct Anchor {
    std::size_t frame = 0;
    Fits fits;  // the fit of `frame`, and the fits of the frames around it to which TrialCost has followed the body
  };

  Anchor AnchorAt(std::size_t frame, SilhouetteFit fit) const {
    Anchor anchor{frame, Fits(frame_count_)};
    anchor.fits[frame] = std::move(fit);
    return anchor;
  }

  bool Shows(std::size_t frame) const { return views_[frame].size() >= 2; }

  std::optional<Anchor> KnownAnchor() {
    if (!take_.start) return std::nullopt;
    for (std::size_t frame = 0; frame < frame_count_; ++frame) {
      if (!Shows(frame)) continue;
      return AnchorAt(frame, fitter_.FitKnown(views_[frame], *take_.start));
    }
    return std::nullopt;
  }

  // Follows the body from the pose of `anchor` through the frames around it, and returns the mean cost of these frames.
  // As soon as the mean is certain to exceed `limit`, returns infinity.
  double TrialCost(Anchor& anchor, double limit) {
    constexpr double kRounding = 1e-9;  // far above the relative rounding error of a sum
    const std::size_t reach = options_.trial_frames;
    const std::size_t first = anchor.frame < reach ? 0 : anchor.frame - reach;
    const std::size_t last = std::min(anchor.frame + reach, frame_count_ - 1);
    const auto count = std::ranges::count_if(std::views::iota(first, last + 1), [&](auto k) { return Shows(k); });
    const double most = limit * static_cast<double>(count) * (1 + kRounding);
    if (!Follow(anchor.frame, last, anchor.fits, most) || !Follow(anchor.frame, first, anchor.fits, most)) {
      return std::numeric_limits<double>::infinity();
    }
    double sum = 0;
    for (std::size_t k = first; k <= last; ++k) sum += anchor.fits[k] ? anchor.fits[k]->cost : 0;
    return sum / static_cast<double>(count);
  }

  // Returns at most kFollowedAnchors start poses for following the take: the known start first, then poses found in the
  // pictures, the most likely first.
  std::vector<Anchor> ChooseAnchors() {
    std::vector<Anchor> anchors = FindAnchors();
    if (const std::optional<Anchor> known = KnownAnchor()) anchors.insert(anchors.begin(), *known);
    if (anchors.size() > kFollowedAnchors) anchors.resize(kFollowedAnchors);
    return anchors;
  }

  // Returns at most `most` frames, evenly spaced over the frames that show a person.
  std::vector<std::size_t> MomentsOf(int most) const {
    std::vector<std::size_t> shown, frames;
    for (std::size_t k = 0; k < frame_count_; ++k) {
      if (Shows(k)) shown.push_back(k);
    }
    const std::size_t count = std::min<std::size_t>(most, shown.size());
    for (std::size_t i = 0; i < count; ++i) frames.push_back(shown[(2 * i + 1) * shown.size() / (2 * count)]);
    return frames;
  }

  std::vector<Anchor> FindAnchors() {
    std::vector<std::pair<double, Anchor>> best;
    for (const std::size_t frame : MomentsOf(options_.anchors)) {
      for (SilhouetteFit& fit : fitter_.Find(views_[frame])) {
        const bool is_full = best.size() == kFollowedAnchors;
        Anchor anchor = AnchorAt(frame, std::move(fit));
        const double cost = TrialCost(anchor, is_full ? best.back().first : std::numeric_limits<double>::infinity());
        best.emplace_back(cost, std::move(anchor));
        std::ranges::stable_sort(best, {}, [](const auto& one) { return one.first; });
        if (is_full) best.pop_back();
      }
    }
    std::vector<Anchor> anchors;
    for (auto& [cost, anchor] : best) anchors.push_back(std::move(anchor));
    return anchors;
  }

  // Fits the frames from `from` (exclusive) to `to`, forwards or backwards in time, each from the frame before it.
  // Frames that are fitted already stay as they are. Stops, and returns false, when the sum of the costs in `fits`
  // exceeds `most`.
  bool Follow(std::size_t from, std::size_t to, Fits& fits, double most = std::numeric_limits<double>::infinity()) {
    const int step = to >= from ? 1 : -1;
    const auto add = [](double sum, const auto& fit) { return fit ? sum + fit->cost : sum; };
    double sum = std::accumulate(fits.begin(), fits.end(), 0.0, add);
    TreeState last = fits[from]->state, before_last = last;
    for (std::size_t k = from; k != to && sum <= most;) {
      k += step;
      if (!Shows(k)) continue;
      if (!fits[k]) {
        fits[k] = fitter_.Follow(views_[k], before_last, last);
        sum += fits[k]->cost;
      }
      before_last = std::move(last);
      last = fits[k]->state;
    }
    return sum <= most;
  }

  Fits FollowBothWays(const Anchor& anchor) {
    Fits fits = anchor.fits;
    Follow(anchor.frame, frame_count_ - 1, fits);
    Follow(anchor.frame, 0, fits);
    return fits;
  }

  // A body turned front to back, with left and right limbs exchanged, has nearly the same silhouettes. This function
  // searches for the reversed body in a few frames, from the limb positions in `fits`, and follows it through the take.
  // The reversed body is taken only if its cost, with the angle priors, is clearly lower: errors of neighbouring frames
  // are correlated, so a small difference between sums over frames may be due to chance.
  Fits EitherWayRound(Fits fits) {
    // Find the reversed pose with the lowest trial cost.
    std::optional<Anchor> likeliest;
    double least = 0;
    for (const std::size_t frame : MomentsOf(kTurnedMoments)) {
      if (!fits[frame]) continue;
      const TreeState turned = TurnedRound(body_, fits[frame]->state);
      Anchor anchor = AnchorAt(
          frame, fitter_.WithLimbsFound(views_[frame], fitter_.Fit(views_[frame], turned, nullptr, true), nullptr));
      const double cost = TrialCost(anchor, likeliest ? least : std::numeric_limits<double>::infinity());
      if (likeliest && cost >= least) continue;
      likeliest = std::move(anchor);
      least = cost;
    }
    if (!likeliest) return fits;
    // Follow the reversed body through the take, and compare the costs.
    const Fits followed = FollowBothWays(*likeliest);
    const Fits turned = Better(followed, Retraced(followed));
    return OwnCost(turned) < kClearlyBetter * OwnCost(fits) ? Better(fits, turned) : fits;
  }

  // Returns the sum of the frames' own costs; changes from frame to frame do not count.
  double OwnCost(const Fits& fits) {
    double sum = 0;
    for (std::size_t k = 0; k < frame_count_; ++k) {
      if (fits[k]) sum += CostOf(body_, views_[k], fits[k]->state, nullptr, options_.cost, fitter_.workspace()).cost;
    }
    return sum;
  }

  // Follows the take forwards and backwards, beginning with the pose that `fits` has at the start or at the end, and
  // combines the two paths (`Better`).
  Fits Retraced(const Fits& fits) {
    const auto first = std::ranges::find_if(fits, [](const auto& fit) { return fit.has_value(); });
    const auto last = std::find_if(fits.rbegin(), fits.rend(), [](const auto& fit) { return fit.has_value(); });
    Fits forwards(frame_count_), backwards(frame_count_);
    const auto begin = static_cast<std::size_t>(first - fits.begin());
    const std::size_t end = frame_count_ - 1 - static_cast<std::size_t>(last - fits.rbegin());
    forwards[begin] = *first;
    Follow(begin, end, forwards);
    backwards[end] = *last;
    Follow(end, begin, backwards);
    return Better(forwards, backwards);
  }

  // Chooses the pose of `a` or `b` in each frame by Viterbi's algorithm, which minimises the sum of the frames' costs
  // and of the changes between frames.
  Fits Better(const Fits& a, const Fits& b) const {
    Fits kept(frame_count_);
    std::vector<std::size_t> shown;
    for (std::size_t k = 0; k < frame_count_; ++k) {
      if (a[k] && b[k]) shown.push_back(k);
    }
    if (shown.empty()) return kept;
    const auto of = [&](std::size_t i, int which) -> const SilhouetteFit& { return *(which == 0 ? a : b)[shown[i]]; };
    // Forward pass: the lowest cost to reach each of the two poses of every frame.
    std::vector<std::array<int, 2>> came_from(shown.size());
    std::array<double, 2> costs = {of(0, 0).picture_cost, of(0, 1).picture_cost};
    for (std::size_t i = 1; i < shown.size(); ++i) {
      std::array<double, 2> next{};
      for (int which = 0; which < 2; ++which) {
        std::array<double, 2> through{};
        for (int from = 0; from < 2; ++from) {
          through[from] = costs[from] + StepCost(of(i - 1, from).state, of(i, which).state, options_);
        }
        came_from[i][which] = through[1] < through[0];
        next[which] = through[came_from[i][which]] + of(i, which).picture_cost;
      }
      costs = next;
    }
    // Backward pass: read the path.
    int which = costs[1] < costs[0];
    for (std::size_t i = shown.size(); i-- > 0;) {
      kept[shown[i]] = of(i, which);
      which = came_from[i][which];
    }
    return kept;
  }

  void FitThickness(const Fits& fits) {
    ThicknessEstimate estimate(body_);
    for (std::size_t k = 0; k < frame_count_; ++k) {
      if (fits[k]) estimate.Add(views_[k], fits[k]->state, options_.cost, fitter_.workspace());
    }
    body_ = estimate.Apply();
  }

  void Refit(Fits& fits) {
    for (std::size_t k = 0; k < frame_count_; ++k) {
      if (fits[k]) fits[k] = fitter_.Fit(views_[k], fits[k]->state, nullptr, false);
    }
  }

  // Predicts a frame's pose: the mean of the two neighbouring frames' poses, or the pose of the only neighbour that is
  // fitted.
  std::optional<TreeState> Between(const Fits& fits, std::size_t k) const {
    const bool before = k > 0 && fits[k - 1], after = k + 1 < frame_count_ && fits[k + 1];
    if (before && after) return MeanState(fits[k - 1]->state, fits[k + 1]->state);
    if (before) return fits[k - 1]->state;
    if (after) return fits[k + 1]->state;
    return std::nullopt;
  }

  // Returns the usual cost of a frame in which no limb is lost: the 20th percentile.
  double UsualCost(const Fits& fits) const {
    std::vector<double> costs;
    for (const auto& fit : fits) {
      if (fit) costs.push_back(fit->picture_cost);
    }
    if (costs.empty()) return 0;
    const auto usual = costs.begin() + static_cast<std::ptrdiff_t>(costs.size() / 5);
    std::ranges::nth_element(costs, usual);
    return *usual;
  }

  // In each run of frames with excessive costs, searches for lost limbs in the first and then every fifth frame; the
  // frames between are fitted from the pose of the frame before. Does this forwards, then backwards in time. Each time,
  // `Better` chooses the old or the new pose of each frame.
  void Repair(Fits& fits) {
    constexpr int kFollowed = 4;
    const double too_much = options_.lost * UsualCost(fits);
    for (const int step : {1, -1}) {
      Fits repaired = fits;
      int followed = kFollowed;
      for (std::size_t i = 0; i < frame_count_; ++i) {
        const std::size_t k = step > 0 ? i : frame_count_ - 1 - i;
        if (!fits[k] || fits[k]->picture_cost <= too_much) {
          followed = kFollowed;
          continue;
        }
        if (++followed > kFollowed) {
          repaired[k] = fitter_.WithLimbsFound(views_[k], *fits[k], nullptr);
          followed = 0;
        } else if (const auto& last = repaired[k - static_cast<std::size_t>(step)]) {
          const PosePrior prior = fitter_.PriorNear(last->state);
          repaired[k] = fitter_.Fit(views_[k], last->state, &prior, true);
        }
      }
      fits = Better(fits, repaired);
    }
  }

  // Fits every frame once more, with the mean of the neighbouring frames' poses as prior: first the even frames, then
  // the odd frames.
  void Smooth(Fits& fits) {
    for (const bool odd : {false, true}) {
      for (std::size_t k = odd; k < frame_count_; k += 2) {
        const std::optional<TreeState> between = Between(fits, k);
        if (!fits[k] || !between) continue;
        const PosePrior prior{*between, 0.5 * options_.position_change_m, 0.5 * options_.angle_change,
                              0.5 * options_.angle_change};
        SilhouetteFit own = fitter_.Fit(views_[k], fits[k]->state, &prior, false),
                      theirs = fitter_.Fit(views_[k], *between, &prior, false);
        fits[k] = theirs.cost < own.cost ? std::move(theirs) : std::move(own);
      }
    }
  }

  SilhouetteBody body_;
  const SilhouetteTake& take_;
  const TrackOptions& options_;
  const std::size_t frame_count_;
  std::vector<MomentViews> views_;  // one per frame
  InstantFitter fitter_{body_, options_};
};

}  // namespace

SilhouetteTrack TrackSilhouettes(const SilhouetteBody& body, const SilhouetteTake& take, const TrackOptions& options) {
  assert(take.cameras.size() >= 2 && take.silhouettes.size() == take.cameras.size());
  return Tracker(body, take, options).Run();
}

}  // namespace etude
