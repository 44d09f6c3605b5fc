#pragma once

#include <span>
#include <vector>

#include "engine/cameras/camera.h"
#include "engine/capture/synchronise.h"
#include "engine/keypoints/match_people.h"

namespace etude {

struct PeopleSyncOptions {
  SyncOptions clocks;
  FollowOptions follow;
};

/// Estimates how late each camera's pictures are, as the overload for marks does *(ours)*: its frame k was taken at k +
/// offset of the first camera's time. Nobody need know who is who: at each offset every person whom the first camera
/// followed is whomever of the other's people the keypoints meet best, squared distances (`EpipolarGeometry`) in the
/// mean. A camera of which nothing tells the time has offset 0; the first camera's is told by definition.
/// @param cameras without their lenses, as are the pixels
/// @param people of each camera, as many frames as it has
std::vector<ClockOffset> EstimateOffsets(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                         const PeopleSyncOptions& options = {});

/// Returns one camera's people at the first one's times, `frames` of them: between frames each follows the cubic
/// through their own keypoints (`PixelBetween`), as sure as the less sure frame. Nobody is where the film has no
/// frames.
SeenPeople PeopleInTime(const SeenPeople& people, double offset, std::size_t frames, const FollowOptions& options = {});

}  // namespace etude
