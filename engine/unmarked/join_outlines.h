#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/cameras/camera.h"
#include "engine/keypoints/adjust_person.h"
#include "engine/keypoints/recover_person.h"
#include "engine/motion/body.h"

namespace etude {

/// Returns the index in `person.people` of the person `number`, counted from 0 among those whom at least two cameras
/// see; nothing if there are fewer.
std::optional<std::size_t> IndexOfPerson(const RecoveredPerson& person, std::size_t number);

/// Adjusts a person to keypoints and outlines together *(ours)*: the motion estimated from outlines is an additional
/// observation of each joint (`AdjustPersonOptions::outlines`). Returns true if that was solved; otherwise `person`
/// stays as it was.
/// @param cameras without their lenses' distortion, like the pixels of `seen`
/// @param seen the keypoints that `person` was recovered from
/// @param outlines the same frames as `person`, in its world
bool JoinOutlines(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, const BodyMotion& outlines,
                  AdjustPersonOptions options, RecoveredPerson& person);

}  // namespace etude
