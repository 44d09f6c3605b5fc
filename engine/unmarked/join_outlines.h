#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "engine/cameras/camera.h"
#include "engine/keypoints/adjust_person.h"
#include "engine/keypoints/recover_person.h"
#include "engine/motion/body.h"

namespace etude {

/// Returns the index in `person.people` of person number `number`. Persons are numbered from 0; persons whom fewer
/// than two cameras see have no number. Returns nullopt if no person has this number.
std::optional<std::size_t> IndexOfPerson(const RecoveredPerson& person, std::size_t number);

/// Adjusts a person to keypoints and outlines together *(ours)*: the motion estimated from outlines is an additional
/// observation of each joint (`AdjustPersonOptions::outlines`). Returns true if the adjustment succeeded; otherwise
/// `person` is unchanged.
/// @param cameras pinhole projections; the pixels of `seen` must be undistorted
/// @param seen the keypoints from which `person` was recovered
/// @param outlines the motion in the frames and the world of `person`
bool JoinOutlines(std::span<const ProjectionMatrix> cameras, const MatchedPerson& seen, const BodyMotion& outlines,
                  AdjustPersonOptions options, RecoveredPerson& person);

}  // namespace etude
