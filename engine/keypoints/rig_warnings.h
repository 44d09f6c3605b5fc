#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// Returns warnings about the rig, or about how the keypoints were read, one sentence each *(ours)*. Nothing is
/// corrected, because keypoints do not show which of the two is wrong.
///
/// **Focal lengths**: for each of the first eight films, and for all films together, the factor on the focal length
/// (within 12 % of 1) is found that minimises Σ d² / (d² + 9 σ²). Here d are the distances of keypoints from the
/// other films' epipolar lines, and σ is their usual size. Of these factors, the one with the smallest sum is judged:
/// a warning is given if it differs from 1 by at least 2 % and by four of its standard errors. The standard error is
/// the jackknife's, over landmarks or over tenths of the time, whichever is larger, so that constant errors of an
/// estimator are taken into account. The median distance must also fall; if it falls by less than 5 %, the warning
/// calls the evidence weak. If all focal lengths are wrong by the same factor, mainly the person's size changes. With
/// errors of 2 px, the standard error of the factor is then 1 % for four cameras around the person, and 4 % for two, so
/// two cameras give no warning.
///
/// **Coordinates relative to a square**, if interpreted as relative to the picture, show a person who is too wide or
/// too narrow. A warning is given if the ratio of shoulder width to leg length differs from the usual 0.42 by a factor
/// above 1.17, and another interpretation brings the ratio nearer to 0.42 and reduces the distances of rays. A factor
/// above 1.1 is enough if that interpretation reduces these distances by a tenth.
/// @param cameras the cameras of the films, without lens distortion; all pixels must be undistorted
std::vector<std::string> RigWarnings(std::span<const Camera> cameras, std::span<const std::string> names,
                                  const MatchedPerson& person, double min_confidence);

}  // namespace etude
