#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// Returns warnings about the rig, or about how the keypoints were read, one sentence each *(ours)*. Nothing is
/// corrected, because keypoints do not tell which of the two is wrong.
///
/// **Focal lengths** of one film or of all: the factor, at most 12 % from 1, that minimises Σ d² / (d² + 9 σ²), where d
/// are the distances of keypoints from the other films' epipolar lines and σ is their usual size. A warning is given if
/// the factor is off by at least 2 % and by four of its standard errors. The standard error is the jackknife's, over
/// landmarks or over tenths of the time, whichever is larger, so that an estimator's constant errors count as errors.
/// If all focal lengths are wrong by the same factor, the person merely has another size: at 2 px the error of the
/// factor is then 1 % with four cameras around, and 4 % with two, which give no warning.
///
/// **Relative coordinates of a square** that were read as relative coordinates of the picture show a squat or a lean
/// person. A warning is given if the ratio of shoulders to legs differs from the usual 0.42 by a factor of more than
/// 1.17, and another reading brings it nearer and lowers the rays' distances; or by more than 1.1, if these fall by a
/// tenth.
/// @param cameras of the films, without distortion; the pixels are undistorted, too
std::vector<std::string> RigWarnings(std::span<const Camera> cameras, std::span<const std::string> names,
                                  const MatchedPerson& person, double min_confidence);

}  // namespace etude
