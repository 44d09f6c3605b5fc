#pragma once

#include <span>

#include "engine/cameras/camera.h"
#include "engine/keypoints/recover_person.h"

namespace etude {

struct AdjustPersonOptions {
  double rate_hz = 30;
  double least_confidence = 0.1;  ///< keypoints below are passed over
  double acceleration = 8;        ///< the least usual one of a joint along each axis, m/s²
  /// The motion that outlines tell in the same frames; null: none. Each joint of it counts for as much as it is usually
  /// off the motion that keypoints alone tell.
  const BodyMotion* outlines = nullptr;
};

/// Estimates the standard deviation of a person's keypoints along u and v, pixels, from how far those of each landmark
/// miss the point that they make: n views of a point have 2n − 3 degrees of freedom. At least a tenth of a pixel. What
/// all cameras err alike, and along a line of two cameras' rays, is not seen by it.
double KeypointErrorPx(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, double least_confidence,
                       double outlier_px);

/// Adjusts a recovered motion as a whole (`AdjustBundle`) *(ours)*: one body, the lengths of its bones and its poses in
/// all frames, that explains the keypoints of all pictures at once, each as sure as its confidence and the error of all
/// say, far ones mistrusted, in a motion of small accelerations: of each joint as large as its own over a tenth of a
/// second, what the noise adds taken off. Where a landmark is seen by fewer than two cameras the joint stays about
/// where the frame by itself had it, to a tenth of the person's height; joints that are made of landmarks beside them
/// to a hundredth. The trunk is one length, and bends where that explains more than 3° of it. Returns whether it was
/// solved; else `person` is as it was.
/// @param cameras without their lenses, as are the pixels, in the world of `person`
/// @param seen the keypoints that `person` was recovered from
bool AdjustPerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen,
                  const AdjustPersonOptions& options, RecoveredPerson& person);

}  // namespace etude
