#pragma once

#include <span>

#include "engine/cameras/camera.h"
#include "engine/keypoints/recover_person.h"

namespace etude {

struct AdjustPersonOptions {
  double rate_hz = 30;
  double min_confidence = 0.1;  ///< keypoints of lower confidence are ignored
  double acceleration = 8;      ///< smallest standard deviation of a joint's acceleration along each axis, m/s²
  /// The motion recovered from silhouettes in the same frames; null if there is none. A joint of this motion has less
  /// weight the farther it usually is from the same joint in the motion from keypoints alone.
  const BodyMotion* outlines = nullptr;
};

/// Estimates the standard deviation of a person's keypoints along u and v, pixels, from the residuals of their
/// triangulation: a point seen in n views has 2n − 3 degrees of freedom. Returns at least a tenth of a pixel. The
/// estimate does not contain errors that all cameras share, nor errors along the common epipolar line of two cameras.
double KeypointErrorPx(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, double min_confidence,
                       double outlier_px);

/// Adjusts a recovered motion as a whole (`AdjustBundle`) *(ours)*: it finds one body (bone lengths) and its poses in
/// all frames that together explain the keypoints of all pictures. A keypoint's standard deviation follows from its
/// confidence and `KeypointErrorPx`; the loss is robust. A prior on accelerations keeps the motion smooth. The
/// prior's standard deviation is estimated for each joint, from accelerations over a tenth of a second, from which the
/// share of noise is subtracted. If fewer than two
/// cameras see a landmark, the landmark's joint is kept near the position that FitPerson found in that frame, with a
/// standard deviation of a tenth of the person's height; if no camera ever sees the landmark, the standard deviation is
/// twice the keypoint error. The trunk has one length; the spine does not bend forward or sideways. Returns true if the
/// problem was solved; otherwise `person` is unchanged.
/// @param cameras the cameras of the rig, without lens distortion, in the world of `person`; all pixels must be
/// undistorted
/// @param seen the keypoints from which `person` was recovered
bool AdjustPerson(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen,
                  const AdjustPersonOptions& options, RecoveredPerson& person);

}  // namespace etude
