#pragma once

#include "engine/base/angles.h"
#include "engine/silhouettes/silhouette_cost.h"

namespace etude {

/// How a body is found and followed, by `TrackSilhouettes` through a whole take and by `SilhouetteFollower` as it
/// comes.
struct TrackOptions {
  SilhouetteCostOptions cost;
  /// How exact a known start is: standard deviation of an angle and of the root's turn, radians, and of its place.
  double start_angle = Radians(10);
  double start_place_m = 0.1;
  /// Cold, of a whole take: at how many moments, evenly over it, the body is searched for.
  int anchors = 5;
  /// Cold: how many frames each of the likeliest poses is followed, to tell front from back: a single silhouette often
  /// cannot.
  int trial_frames = 8;
  /// How far the body moves from one frame to the next beyond what its speed foretells, where pictures do not tell:
  /// standard deviation of an angle, radians. Frames that are further apart than those of 30 Hz want more.
  double angle_change = 0.15;
  double place_change_m = 0.05;
  /// A frame that costs this many times what the best fifth does has lost a limb or more, and is searched anew.
  double lost = 1.8;
  /// Of a whole take: how often lost frames are searched anew and all are smoothed.
  int repairs = 2;
  /// How often the thickness of trunk, head, arms and legs is estimated from what was seen, each time nearer: a person
  /// is no average. 0 keeps the average.
  int thickness_passes = 2;
};

}  // namespace etude
