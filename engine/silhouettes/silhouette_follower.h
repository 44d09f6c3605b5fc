#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/moment_fitter.h"
#include "engine/silhouettes/silhouette.h"

namespace etude {

/// Follows a body by its silhouettes moment by moment, as it happens, each pose from the pictures up to it alone.
/// Without a known start it is searched for in the first moment that shows somebody; the likeliest poses are followed
/// beside each other for `trial_frames` and the one that explained most is kept. When a moment costs far more than most
/// did, arms and legs are looked for elsewhere. The thickness is estimated from what was seen so far. A pose that was
/// told is never taken back: nothing is smoothed.
class SilhouetteFollower {
 public:
  /// @param cameras world (metres) to pixels, at least two
  /// @param start about where the body is in the first moment, when that is known
  SilhouetteFollower(const SilhouetteBody& body, std::span<const ProjectionMatrix> cameras,
                     const std::optional<TreeState>& start, const TrackOptions& options = {});
  SilhouetteFollower(const SilhouetteFollower&) = delete;
  SilhouetteFollower& operator=(const SilhouetteFollower&) = delete;

  /// Fits the next moment's pictures, one per camera. Returns nothing when fewer than two show anybody, or nobody can
  /// be found.
  std::optional<SilhouetteFit> Next(std::span<const Silhouette> silhouettes);

  /// Returns the body with its thickness as estimated so far.
  const SilhouetteBody& body() const { return body_; }

 private:
  /// A pose that is followed.
  struct Path {
    SilhouetteFit fit;
    TreeState before;  ///< the pose before that
    double cost = 0;   ///< of all its moments, by their pictures
  };

  void Begin(const MomentViews& views);
  void Follow(const MomentViews& views, Path& path);
  bool IsLost(const SilhouetteFit& fit) const;
  void Learn(const MomentViews& views);

  const TrackOptions options_;
  SilhouetteBody body_;
  const std::vector<ProjectionMatrix> cameras_;
  const std::optional<TreeState> start_;
  MomentFitter fitter_{body_, options_};
  std::vector<Path> paths_;    ///< the likeliest first; none before somebody was found
  int moments_ = 0;            ///< since the body was found
  int since_search_ = 0;       ///< moments since limbs were looked for
  std::vector<double> costs_;  ///< of the moments that were told, in their order
  std::optional<ThicknessEstimate> thickness_;
  int thickness_passes_ = 0, thickness_moments_ = 0;
};

}  // namespace etude
