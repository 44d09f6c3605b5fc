#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/instant_fitter.h"
#include "engine/silhouettes/silhouette.h"

namespace etude {

/// Follows a body by its silhouettes online: each pose depends only on the pictures up to its moment (a moment is the
/// pictures of one time). Without a known start, the body is searched for in the first moment that shows somebody; the
/// most likely poses are followed in parallel for `trial_frames`, and the pose with the lowest total cost is kept. If
/// the cost of a moment is far higher than usual, other positions of arms and legs are tried. The thickness is
/// estimated from the pictures so far. Returned poses are final; they are not smoothed afterwards.
class SilhouetteFollower {
 public:
  /// @param cameras projections from the world (metres) to pixels, at least two
  /// @param start the body's approximate pose in the first moment, if known
  SilhouetteFollower(const SilhouetteBody& body, std::span<const ProjectionMatrix> cameras,
                     const std::optional<TreeState>& start, const TrackOptions& options = {});
  SilhouetteFollower(const SilhouetteFollower&) = delete;
  SilhouetteFollower& operator=(const SilhouetteFollower&) = delete;

  /// Fits the pictures of the next moment, one for each camera. Returns nullopt if fewer than two pictures show a
  /// person, or if the search finds no body.
  std::optional<SilhouetteFit> Next(std::span<const Silhouette> silhouettes);

  /// Returns the body with the thickness estimated so far.
  const SilhouetteBody& body() const { return body_; }

 private:
  /// One of several candidate sequences of poses, which are followed in parallel.
  struct Path {
    SilhouetteFit fit;
    TreeState before;  ///< the last pose but one
    double cost = 0;   ///< sum of `picture_cost` over the path's moments
  };

  void Begin(const MomentViews& views);
  void Follow(const MomentViews& views, Path& path);
  bool IsLost(const SilhouetteFit& fit) const;
  void Learn(const MomentViews& views);

  const TrackOptions options_;
  SilhouetteBody body_;
  const std::vector<ProjectionMatrix> cameras_;
  const std::optional<TreeState> start_;
  InstantFitter fitter_{body_, options_};
  std::vector<Path> paths_;    ///< by ascending cost; empty until somebody was found
  int moments_ = 0;            ///< moments (all films' pictures of one time) since the body was found
  int since_search_ = 0;       ///< moments since the last search for limbs
  std::vector<double> costs_;  ///< `picture_cost` of the last returned fits, oldest first
  std::optional<ThicknessEstimate> thickness_;
  int thickness_passes_ = 0, thickness_moments_ = 0;
};

}  // namespace etude
