#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/keypoints/match_people.h"

namespace etude {

/// Returns what a person's keypoints say against the rig or the way they were read, a sentence each *(ours)*; nothing
/// is mended by it, for keypoints do not tell which is true.
///
/// **Focal lengths**, one film's or all alike: the factor, at most 12 % off, of the least Σ d² / (d² + 9 σ²), d the
/// distances of keypoints from the other films' epipolar lines, σ what they usually are. It is told where it is 2 %
/// off, and four of its own standard errors: the jackknife's, over kinds of landmarks or tenths of the time, whichever
/// is more, so that what an estimator errs alike in all frames counts as error. Where all films are off alike the
/// person merely has another size: at 2 px the error is 1 % with four cameras around, 4 % with two, which tell nothing
/// then.
///
/// **Shares of a square**, read as shares of the picture: they show a squat or a lean person. Told where shoulders are
/// more than 1.17 times too wide or too narrow for legs (.42 of a leg is usual), another reading makes them likelier
/// and rays miss by less; or 1.1 times, and rays miss by a tenth less.
/// @param cameras of the films, without their lenses, as are the pixels
std::vector<std::string> DoubtRig(std::span<const Camera> cameras, std::span<const std::string> names,
                                  const MatchedPerson& person, double least_confidence);

}  // namespace etude
