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

/// Estimates the delay of each camera's pictures *(ours)*, like the overload for marks in
/// `engine/capture/synchronise.h`: frame k of a camera was taken at the first camera's time k + offset. People need not
/// be identified: at each offset, every person tracked in another camera is compared with all people of this camera,
/// and the person with the lowest mean squared epipolar distance (`EpipolarGeometry`) counts. The cameras that agree
/// with each other determine the offsets: first the pair that shows its offset most clearly, then one camera at a time.
/// A camera whose offset cannot be determined gets 0, and its `is_told` is false. The offset of the first camera is 0
/// by definition; if its `is_told` is false, the offset of the first camera with `is_told` is 0.
/// @param cameras the cameras of the rig, without lens distortion; all pixels must be undistorted
/// @param people the people of each camera, each with its own number of frames
std::vector<ClockOffset> EstimateOffsets(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                         const PeopleSyncOptions& options = {});

/// A film whose delay against the other films changes.
struct ClockDrift {
  std::size_t film = 0;
  double frames = 0;  ///< how much later its frames are in the second half than in the first, frames
  /// The misfits of its keypoints with those of the other films, root mean square, pixels: with the best constant
  /// delay, and with a delay of its own for each quarter of the film.
  double constant_px = 0, changing_px = 0;
};

/// Finds the films whose clocks drift *(ours)*, from the delays in the four quarters of the films: the film that drifts
/// most against all others, then the next one without that film, and so on. The delays must increase, or decrease, from
/// quarter to quarter, by at least half a frame between the halves, and must explain a tenth of the squared misfits. Of
/// two films, only the second can be named. Delays of at most a sixteenth of the film are searched.
/// @param people the people of each camera at the first camera's times (`PeopleInTime`)
std::vector<ClockDrift> FindDrifts(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                   const PeopleSyncOptions& options = {});

/// A film's clock: frame k of the film was taken at offset + (1 + drift) · k, in frames of the first film.
struct FilmClock {
  double offset = 0;
  double drift = 0;

  double FrameAt(double time) const { return (time - offset) / (1 + drift); }
  friend bool operator==(const FilmClock&, const FilmClock&) = default;
};

struct FoundClock {
  FilmClock clock;
  double before = 0, after = 0;  ///< losses of the given clock and of `clock`; set if `is_mended`
  bool is_mended = false;        ///< false if `clock` is still the given clock
  FilmClock nearest;             ///< the clock of minimal loss, even if it was not accepted
};

/// Finds clocks that explain the keypoints much better than the given clocks *(ours)*. The search covers offsets that
/// differ by up to `max_frames` from the given offsets, and drifts of up to three frames over half of the film. It
/// minimises the mean Geman–McClure loss of epipolar distances, with a scale of 1 % of the person's height in the
/// picture, at least 1.5 pixels: first on a grid, then with ever smaller steps down to 1/500 of a frame. A clock is
/// changed only if this halves the loss, because wrong keypoints alone are not evidence of a wrong clock.
std::vector<FoundClock> FindClocks(std::span<const ProjectionMatrix> cameras, std::span<const SeenPeople> people,
                                   std::span<const FilmClock> given, int max_frames, const FollowOptions& options);

/// Returns `frames` frames of one camera's people at the first camera's times. Between two frames, each keypoint's
/// pixel follows a cubic (`PixelBetween`), and its confidence is the lower one of the two frames. At times without
/// frames of the film, nobody is present. `PeopleAt` takes the fractional frame for each of the times; nobody is
/// present at negative ones.
SeenPeople PeopleInTime(const SeenPeople& people, const FilmClock& clock, std::size_t frames,
                        const FollowOptions& options = {});
SeenPeople PeopleAt(const SeenPeople& people, std::span<const double> frames, const FollowOptions& options = {});
SeenPeople PeopleInTime(const SeenPeople& people, double offset, std::size_t frames, const FollowOptions& options = {});

}  // namespace etude
