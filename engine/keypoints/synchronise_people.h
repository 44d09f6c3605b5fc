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

/// A film's clock: its frame k was taken at offset + (1 + drift) · k, in frames of the first film.
struct FilmClock {
  double offset = 0;
  double drift = 0;

  double FrameAt(double time) const { return (time - offset) / (1 + drift); }
  friend bool operator==(const FilmClock&, const FilmClock&) = default;
};

struct FoundClock {
  FilmClock clock;
  double before = 0, after = 0;  ///< the loss of the clock that was given, and of the one that was found
  bool is_mended = false;        ///< false: `clock` is the one that was given
  FilmClock nearest;             ///< the clock of the least loss, whether that says enough or not
};

/// Finds clocks that explain the keypoints far better than those that are given *(ours)*: offsets up to `most_frames`
/// from them and drifts that make up to three frames over the film, by the mean Geman–McClure loss of epipolar
/// distances at 1 % of the height, first on a grid and then ever finer to a five-hundredth of a frame. A clock that
/// does not halve the loss is left as it is: keypoints that err are no reason to move a clock.
std::vector<FoundClock> FindClocks(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                   std::span<const FilmClock> given, int most_frames, const FollowOptions& options);

/// Returns one camera's people at the first one's times, `frames` of them: between frames each follows the cubic
/// through their own keypoints (`PixelBetween`), as sure as the less sure frame. Nobody is where the film has no
/// frames.
SeenPeople PeopleInTime(const SeenPeople& people, const FilmClock& clock, std::size_t frames,
                        const FollowOptions& options = {});
SeenPeople PeopleInTime(const SeenPeople& people, double offset, std::size_t frames, const FollowOptions& options = {});

}  // namespace etude
