#pragma once

#include <span>
#include <vector>

#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/silhouette_body.h"
#include "engine/silhouettes/track_options.h"

namespace etude {

/// The cameras' pictures of one moment, as far as they show somebody.
using MomentViews = std::vector<SilhouetteView>;

/// Where a body is at one moment: searched for, started from a known pose, or followed from the moments before.
class MomentFitter {
 public:
  /// Both must outlive this; the body may grow thicker or thinner in between.
  MomentFitter(const SilhouetteBody& body, const TrackOptions& options);

  /// One moment's fit from `start`, `is_far`: with a wide reach first. `prior` may be null.
  SilhouetteFit Fit(const MomentViews& views, const TreeState& start, const PosePrior* prior, bool is_far);
  /// From a start that is known as exactly as the options say.
  SilhouetteFit FitKnown(const MomentViews& views, const TreeState& start);
  /// The next moment of a body that was at `before_last` and then at `last`.
  SilhouetteFit Follow(const MomentViews& views, const TreeState& before_last, const TreeState& last);
  /// The body as it may stand there: the likeliest pose and the likeliest ones that face other ways, at most three.
  /// None where the lines of sight do not meet.
  std::vector<SilhouetteFit> Find(const MomentViews& views);
  /// The fit with every arm and leg looked for elsewhere, where that costs less.
  SilhouetteFit WithLimbsFound(const MomentViews& views, const SilhouetteFit& fit, const PosePrior* prior);
  /// That the next moment is near this one.
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
