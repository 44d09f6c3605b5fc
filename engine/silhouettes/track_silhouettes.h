#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/angles.h"
#include "engine/cameras/camera.h"
#include "engine/silhouettes/fit_silhouettes.h"
#include "engine/silhouettes/silhouette.h"
#include "engine/silhouettes/silhouette_body.h"

namespace etude {

struct SilhouetteTake {
  /// World (metres) to pixels. At least two.
  std::span<const ProjectionMatrix> cameras;
  /// `silhouettes[camera][frame]`, taken at the same moments.
  std::span<const std::vector<Silhouette>> silhouettes;
  /// About where the body is in the first frame, when that is known: people are asked to begin in an agreed pose.
  /// Nothing: the start is found from the pictures ("cold").
  std::optional<TreeState> start;
};

struct TrackOptions {
  SilhouetteCostOptions cost;
  /// How exact a known start is: standard deviation of an angle and of the root's turn, radians, and of its place.
  double start_angle = Radians(10);
  double start_place_m = 0.1;
  /// Cold: at how many moments, evenly over the take, the body is searched for.
  int anchors = 5;
  /// Cold: how many frames each of the likeliest poses is followed, to tell front from back: a single silhouette often
  /// cannot.
  int trial_frames = 8;
  /// How far the body moves from one frame to the next beyond what its speed foretells, where pictures do not tell:
  /// standard deviation of an angle, radians.
  double angle_change = 0.15;
  double place_change_m = 0.05;
  /// A frame that costs this many times what the best fifth does has lost a limb or more, and is searched anew.
  double lost = 1.8;
  /// How often lost frames are searched anew and all are smoothed.
  int repairs = 2;
  /// How often the thickness of trunk, head, arms and legs is estimated from the take, each time nearer: a person is no
  /// average. 0 keeps the average.
  int thickness_passes = 2;
};

/// The body's pose in every frame, and the body with its thickness as estimated.
struct SilhouetteTrack {
  SilhouetteBody body;
  std::vector<std::optional<SilhouetteFit>> frames;  ///< nothing where fewer than two pictures show anybody
};

/// Follows a body through a take by its silhouettes alone: found in a few frames by trying headings and postures, or
/// started from a known pose; fitted from frame to frame forwards, and backwards from the end; of both, the poses are
/// kept that cost less and move less (Viterbi's shortest path). Then limbs that were lost are looked for, and every
/// frame is fitted once more with its neighbours in sight.
SilhouetteTrack TrackSilhouettes(const SilhouetteBody& body, const SilhouetteTake& take,
                                 const TrackOptions& options = {});

}  // namespace etude
