#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <optional>

namespace etude {

struct SyncOptions {
  /// The largest offset that is looked for, frames either way. Raise it for cameras that were started by hand.
  int most_frames = 16;
  /// Of an end whose sightings miss each other by more pixels than this, the excess does not count: a mark on the
  /// wrong limb must not set a clock.
  double most_px = 20;
};

struct ClockOffset {
  double frames = 0;
  /// Whether misfits tell it: on average they are a quarter more than the least, which is not at an end of the search.
  /// False: nobody moves, or the clock is further off, and `frames` is a guess.
  bool is_told = false;
};

/// The offset at which `misfit`, pixels squared, is least: of all whole frames the best one, then where the parabola
/// through its neighbourhood is lowest. Between frames nothing is asked, because an interpolated pixel errs less than
/// those it is made of, which would draw every offset to a half. 0 where it is hardly less than at 0, or nothing there.
ClockOffset FindOffset(const std::function<std::optional<double>(int offset)>& misfit, int most_frames);

/// A pixel `share` of the way from b to c, frames next to each other whose neighbours are a and d: a cubic through all
/// (Catmull-Rom), straight where a or d is missing, nothing where b or c is.
using SomePixel = std::optional<glm::dvec2>;
SomePixel PixelBetween(const SomePixel& a, const SomePixel& b, const SomePixel& c, const SomePixel& d, double share);

}  // namespace etude
