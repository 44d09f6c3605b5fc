#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/moment_fitter.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

struct SilhouetteTake {
  /// World (metres) to pixels. At least two.
  std::span<const ProjectionMatrix> cameras;
  /// `silhouettes[camera][frame]`, taken at the same moments.
  std::span<const std::vector<Silhouette>> silhouettes;
  /// The body's approximate state in the first frame, when it is known because people begin in an agreed pose. Without
  /// one the start is found from the pictures ("cold").
  std::optional<TreeState> start;
  /// `joints[camera][frame]`: what is told of joints beside outlines; empty where nobody tells any.
  std::span<const std::vector<std::vector<SeenJoint>>> joints = {};
};

/// The body's pose in every frame, and the body with its thickness as estimated.
struct SilhouetteTrack {
  SilhouetteBody body;
  std::vector<std::optional<SilhouetteFit>> frames;  ///< nothing where fewer than two pictures show anybody
};

/// Follows a body through a take by its silhouettes, and by what is told of its joints: found in a few frames by trying
/// headings and postures, or started from a known pose; fitted from frame to frame forwards, and backwards from the
/// end; of both, the poses are kept that cost less and move less (Viterbi's shortest path); likewise the other way
/// round (`TurnedRound`), where that costs clearly less. Then limbs that were lost are looked for, and every frame is
/// fitted once more with its neighbours in sight.
SilhouetteTrack TrackSilhouettes(const SilhouetteBody& body, const SilhouetteTake& take,
                                 const TrackOptions& options = {});

}  // namespace etude
