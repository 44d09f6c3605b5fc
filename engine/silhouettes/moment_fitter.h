#pragma once

#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/silhouette_body.h"
#include "engine/silhouettes/silhouette_cost.h"

namespace etude {

/// Estimates how thick a person's parts are relative to the average's, by least squares over outline points of many
/// frames: a limb that is seen on both sides is too thin by what its outline lies outside on either. Parts that are
/// seldom seen free stay as they are.
class ThicknessEstimate {
 public:
  explicit ThicknessEstimate(const SilhouetteBody& body);

  /// Adds what one frame shows in the pose `state`.
  void Add(std::span<const SilhouetteView> views, const TreeState& state, const SilhouetteCostOptions& options,
           FitWorkspace& workspace);

  /// Returns the body with its parts of the estimated thickness.
  SilhouetteBody Apply() const;

 private:
  const SilhouetteBody& body_;
  std::vector<double> agrees_, counts_;  // of each part: Σ w r e, Σ w r²
};

/// The options of finding and following a body, by `TrackSilhouettes` through a whole take and by `SilhouetteFollower`
/// as it comes.
struct TrackOptions {
  SilhouetteCostOptions cost;
  /// The accuracy of a known start: standard deviation of an angle and of the root's turn, radians, and of its place.
  double start_angle = Radians(10);
  double start_place_m = 0.1;
  /// The number of moments, evenly over a whole take, at which the body is searched for when the start is not known.
  int anchors = 5;
  /// The number of frames that each of the likeliest poses is followed when the start is not known, to tell front from
  /// back, which a single silhouette often cannot.
  int trial_frames = 8;
  /// The body's movement from one frame to the next beyond what its speed foretells: standard deviations of an angle,
  /// radians, and of the place. Frames that are further apart than those of 30 Hz want more.
  double angle_change = 0.15;
  double place_change_m = 0.05;
  /// The cost of a frame, relative to the best fifth's, above which it has lost a limb or more and is searched anew.
  double lost = 1.8;
  /// The number of passes over a whole take in which lost frames are searched anew and all are smoothed.
  int repairs = 2;
  /// The number of passes in which the thickness of trunk, head, arms and legs is estimated, each time nearer: a person
  /// is no average. 0 keeps the average.
  int thickness_passes = 2;
};

/// The cameras' pictures of one moment, as far as they show somebody.
using MomentViews = std::vector<SilhouetteView>;

/// Fits a body to one moment: searched for, started from a known pose, or followed from the moments before.
class MomentFitter {
 public:
  /// Both must outlive this; the body may grow thicker or thinner in between.
  MomentFitter(const SilhouetteBody& body, const TrackOptions& options);

  /// Fits one moment from `start`, with a wide reach first when `is_far`. `prior` may be null.
  SilhouetteFit Fit(const MomentViews& views, const TreeState& start, const PosePrior* prior, bool is_far);
  /// Fits one moment from a start that is known as exactly as the options say.
  SilhouetteFit FitKnown(const MomentViews& views, const TreeState& start);
  /// Fits the next moment of a body that was at `before_last` and then at `last`.
  SilhouetteFit Follow(const MomentViews& views, const TreeState& before_last, const TreeState& last);
  /// Searches for the body: returns the likeliest pose and the likeliest ones that face other ways, at most three; none
  /// where the lines of sight do not meet.
  std::vector<SilhouetteFit> Find(const MomentViews& views);
  /// Searches for every arm and leg elsewhere and returns the fit with those places that cost less.
  SilhouetteFit WithLimbsFound(const MomentViews& views, const SilhouetteFit& fit, const PosePrior* prior);
  /// Returns the prior that the next moment is near this one.
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
