#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/instant_fitter.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

struct SilhouetteTake {
  /// Projections from the world (metres) to pixels, at least two.
  std::span<const ProjectionMatrix> cameras;
  /// `silhouettes[camera][frame]`; all cameras' frames were taken at the same moments.
  std::span<const std::vector<Silhouette>> silhouettes;
  /// The body's approximate pose in the first frame. It is known if the person begins in an agreed pose; otherwise the
  /// start is found from the pictures (a "cold" start).
  std::optional<TreeState> start;
  /// `joints[camera][frame]`: joints seen in addition to the silhouettes; empty if there are no joints.
  std::span<const std::vector<std::vector<SeenJoint>>> joints = {};
};

/// The body's pose in every frame, and the body with the estimated thickness.
struct SilhouetteTrack {
  SilhouetteBody body;
  std::vector<std::optional<SilhouetteFit>> frames;  ///< nullopt if fewer than two pictures show anybody
};

/// Follows a body through a take by its silhouettes and by the joints seen. The body starts from the known pose, or is
/// found in a few frames by trying headings and postures. Each frame is fitted twice: from the frame before it, and
/// backwards in time from the frame after it. Viterbi's algorithm chooses one of the two poses in each frame. The same
/// is done for the body turned front to back (`TurnedRound`), which is taken if its cost is clearly lower. Finally,
/// lost limbs are searched for, and every frame is fitted once more with the neighbouring frames' poses as a prior.
SilhouetteTrack TrackSilhouettes(const SilhouetteBody& body, const SilhouetteTake& take,
                                 const TrackOptions& options = {});

}  // namespace etude
