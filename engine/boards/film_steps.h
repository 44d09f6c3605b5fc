#pragma once

#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/boards/board_views.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// Returns the views of boards in films that are not in step: the first film's look k was taken when film c's time was
/// k · period_s[0] + late_s[c]. Corners at a moment between two looks lie on the parabola through the same corner in
/// the nearest look and both beside it, or on the line through two. A board that is in no look beside is a target of
/// its own: it tells of its camera alone.
/// @param sightings all of films (`look` ≥ 0)
/// @param period_s between the looks of each film
/// @param late_s of each film; the first one's is 0
std::vector<TargetView> ViewsInStep(std::span<const BoardSighting> sightings, std::span<const double> period_s,
                                    std::span<const double> late_s);

struct FilmSteps {
  std::vector<double> late_s;  ///< of each film, as with `ViewsInStep`; all 0 where films are in step
  double before_px = 0;        ///< residual of all films if they were in step
  double after_px = 0;         ///< … and with `late_s`
};

/// Finds how late films of a moving board are: the times that make the least residual when all cameras are calibrated
/// with them, one film after the other, on a grid of looks first, then by halves to a 64th of a look. *(Ours.)* A film
/// stays where it is unless its time takes a tenth off the residual: boards that rest tell no time. At most 60 moments
/// are tried, those which most films see, evenly. Fails as `CalibrateFromPlanes` does.
/// @param most_s films are late by at most this, either way
Result<FilmSteps> FindFilmSteps(std::span<const PictureSize> sizes, std::span<const BoardSighting> sightings,
                                std::span<const double> period_s, double most_s, const RefineOptions& options = {},
                                const OnProgress& on_progress = {});

}  // namespace etude
