#pragma once

#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/silhouette_body.h"
#include "engine/silhouettes/silhouette_cost.h"

namespace etude {

/// Estimates the thickness of a person's trunk, head, arms and legs relative to the average body, by least squares over
/// the outline points of many frames: if the outline lies outside a capsule on both sides, the capsule is too thin.
/// Parts whose outline is rarely visible keep their thickness.
class ThicknessEstimate {
 public:
  explicit ThicknessEstimate(const SilhouetteBody& body);

  /// Adds the outline points of one frame in which the body's pose is `state`.
  void Add(std::span<const SilhouetteView> views, const TreeState& state, const SilhouetteCostOptions& options,
           FitWorkspace& workspace);

  /// Returns the body with the estimated thickness.
  SilhouetteBody Apply() const;

 private:
  const SilhouetteBody& body_;
  std::vector<double> products_, squares_;  // per body part: Σ w r e, Σ w r² (residual e, radius r)
};

/// Options for finding and following a body. `TrackSilhouettes` uses them for a whole take, `SilhouetteFollower`
/// online.
struct TrackOptions {
  SilhouetteCostOptions cost;
  /// The accuracy of a known start, as standard deviations: of each angle and of the root's rotation (radians), and of
  /// the root's position (metres).
  double start_angle = Radians(10);
  double start_position_m = 0.1;
  /// The number of frames, evenly spaced over the take, in which the body is searched for if the start is not known.
  int anchors = 5;
  /// If the start is not known, each likely pose is followed for this number of frames. A single silhouette often
  /// cannot tell front from back; several frames can.
  int trial_frames = 8;
  /// The expected deviation of a frame from the extrapolated motion: standard deviations of an angle, radians, and of
  /// the position. Use larger values for frame rates below 30 Hz.
  double angle_change = 0.15;
  double position_change_m = 0.05;
  /// If the cost of a frame exceeds this multiple of the 20th percentile of the take's frame costs, a limb is assumed
  /// to be lost and searched again.
  double lost = 1.8;
  /// The number of passes over a whole take in which lost frames are searched again and all frames are smoothed.
  int repairs = 2;
  /// The number of passes that estimate the thickness of trunk, head, arms and legs. Each pass uses the poses of the
  /// previous pass. 0 keeps the average thickness.
  int thickness_passes = 2;
};

/// The views of one moment: the pictures that all cameras took at one time, without pictures that show nobody.
using MomentViews = std::vector<SilhouetteView>;

/// Fits a body to one moment: by a search, from a known pose, or from the previous moments.
class InstantFitter {
 public:
  /// `body` and `options` must outlive this object. The body's thickness may be changed between calls.
  InstantFitter(const SilhouetteBody& body, const TrackOptions& options);

  /// Fits one moment from `start`. If `is_far`, a fit comes first whose loss has a wider reach. `prior` may be null.
  SilhouetteFit Fit(const MomentViews& views, const TreeState& start, const PosePrior* prior, bool is_far);
  /// Fits one moment from a known start; the options state the start's accuracy.
  SilhouetteFit FitKnown(const MomentViews& views, const TreeState& start);
  /// Fits the next moment of a body whose last two poses were `before_last` and `last`.
  SilhouetteFit Follow(const MomentViews& views, const TreeState& before_last, const TreeState& last);
  /// Searches for the body. Returns at most three fits: the most likely pose first, then poses with other headings.
  /// Returns no fit if the silhouettes' centres cannot be triangulated.
  std::vector<SilhouetteFit> Find(const MomentViews& views);
  /// Tries other positions for every arm and leg. Returns the fit with the positions that lower the cost.
  SilhouetteFit WithLimbsFound(const MomentViews& views, const SilhouetteFit& fit, const PosePrior* prior);
  /// Returns a prior with mean `state` for the next pose.
  PosePrior PriorNear(const TreeState& state) const;

  FitWorkspace& workspace() { return workspace_; }

 private:
  std::vector<SilhouetteFit> Guesses(const MomentViews& views);

  const SilhouetteBody& body_;
  const TrackOptions& options_;
  FitOptions wide_, fine_;
  FitWorkspace workspace_;
};

}  // namespace etude
