#pragma once

#include <span>
#include <vector>

#include "engine/base/progress.h"
#include "engine/base/result.h"
#include "engine/boards/board_views.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// Returns the views of boards in films that are not synchronised. A *look* is one of the examined, evenly spaced
/// pictures of a film. Look k of the first film was taken when the time of film c was k · period_s[0] + delay_s[c].
/// Between looks, a corner's position is interpolated by a parabola through the positions in the nearest look and both
/// its neighbours, or by a line through the positions in two looks. If fewer than four corners of a sighting can be
/// interpolated, its own corners become a target of their own, which constrains only its camera.
/// @param sightings the sightings, all from films (`look` ≥ 0)
/// @param period_s time between the looks of each film, seconds
/// @param delay_s delay of each film, seconds; 0 for the first
std::vector<TargetView> SynchronisedViews(std::span<const BoardSighting> sightings, std::span<const double> period_s,
                                    std::span<const double> delay_s);

struct FilmDelays {
  std::vector<double> delay_s;  ///< delay of each film, as for `SynchronisedViews`; all 0 if films are synchronised
  double before_px = 0;         ///< residual of the calibration if all delays are 0, pixels
  double after_px = 0;          ///< residual of the calibration with `delay_s`, pixels
};

/// Finds the delays of films of a moving board *(ours)*: the delays minimise the residual of a calibration of all
/// cameras together. The delays are searched film by film, first on a grid with steps of half the time between looks,
/// then by halving the step down to a 64th of this time. A delay is accepted only if it lowers the residual by a tenth,
/// because boards at rest do not determine time. If the films share targets, at most about 60 targets are used, in
/// evenly spaced blocks of consecutive looks. Fails like `CalibrateFromPlanes`.
/// @param max_delay_s largest delay that is tried, seconds; a film may be late or early
Result<FilmDelays> FindFilmDelays(std::span<const PictureSize> sizes, std::span<const BoardSighting> sightings,
                                std::span<const double> period_s, double max_delay_s, const RefineOptions& options = {},
                                const OnProgress& on_progress = {});

}  // namespace etude
