#pragma once

#include <array>

#include "sim/choreography/controls.h"
#include "sim/choreography/move.h"
#include "sim/performer/person.h"
#include "sim/random/stream.h"

namespace etude {

/// Random offsets, one per control. An offset varies smoothly over one performance and is periodic with the
/// performance's length: it is the sum of a constant and three harmonics. The offsets of left and right are correlated.
/// The spot of a standing foot gets only a constant offset, because the foot must not slide.
class SmoothOffsets {
 public:
  SmoothOffsets() = default;
  /// Draws the offsets. At `size` 1, the standard deviation of the arms' offsets is about 15 degrees, which is the
  /// deviation between people who dance one move (ours).
  SmoothOffsets(RandomStream& random, double size);

  /// Returns the offsets at a share of the performance. The period is 1.
  Controls At(double share) const;

 private:
  static constexpr std::size_t kTerms = 7;
  std::array<std::array<double, kTerms>, kControlCount> terms_{};
};

/// One person's way of dancing one move, the same in all of the person's performances: the choreography with the
/// person's gains and posture, with individual offsets and an individual rhythm. Every joint is kept within the joint's
/// range.
class Style {
 public:
  /// `person` and `move` must outlive this object.
  Style(const Person& person, const Move& move);

  const Person& person() const { return person_; }
  const Move& move() const { return move_; }

  /// Returns the body at `beat` of the move. `vigour`, in (0, 1], is the share of the amplitude that is left when the
  /// person is tired; `chance` holds the offsets of one performance.
  Controls At(double beat, double vigour = 1, const SmoothOffsets& chance = {}) const;

 private:
  const Person& person_;
  const Move& move_;
  SmoothOffsets offsets_;
  std::array<double, 2> rhythm_{};  // amplitudes of the rhythm's first two harmonics, as shares of a performance
};

/// Returns the person's posture at rest.
Controls RestOf(const Person& person);

/// Returns `wanted` with every control kept within its joint's range. A control whose value in `authored` is outside
/// the range may keep this value but must not go beyond it. Near the end of the range the difference from `authored`
/// saturates smoothly.
Controls WithinReach(const Controls& wanted, const Controls& authored);

/// The sway of a body at rest: the weight shifts from foot to foot, the chest breathes, and the head turns.
class Sway {
 public:
  explicit Sway(RandomStream& random);

  /// Returns the offsets that the sway adds to a standing body, `time_s` seconds after the session's first frame.
  Controls At(double time_s) const;

 private:
  std::array<double, 5> phases_{};
};

}  // namespace etude
