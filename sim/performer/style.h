#pragma once

#include <array>

#include "sim/choreography/controls.h"
#include "sim/choreography/move.h"
#include "sim/performer/person.h"
#include "sim/random/stream.h"

namespace etude {

/// Smooth offsets: offsets of every control that change smoothly over one performance and close with it: a constant and
/// three harmonics each. Joints of an arm and the two sides go partly together, as a body's do. Feet that stand keep
/// their spots.
class SmoothOffsets {
 public:
  SmoothOffsets() = default;
  /// Draws the offsets. A `size` of 1 is about 15 degrees in the arms (the standard deviation of people's ways with one
  /// move; ours).
  SmoothOffsets(RandomStream& random, double size);

  /// Returns the offsets at a share of the performance; they repeat after every whole one.
  Controls At(double share) const;

 private:
  static constexpr std::size_t kTerms = 7;
  std::array<std::array<double, kTerms>, kControlCount> terms_{};
};

/// A style is one person's way with one move, the same every time they dance it: the choreography with the person's
/// gains and posture, smooth offsets of their own, and a rhythm of their own within it; no joint beyond its range.
class Style {
 public:
  /// The person and the move must outlive this.
  Style(const Person& person, const Move& move);

  const Person& person() const { return person_; }
  const Move& move() const { return move_; }

  /// Returns the body at `beat` of the move. `vigour`, in (0, 1], is what tiredness leaves of the amplitude; `chance`
  /// are one performance's own offsets.
  Controls At(double beat, double vigour = 1, const SmoothOffsets& chance = {}) const;

 private:
  const Person& person_;
  const Move& move_;
  SmoothOffsets offsets_;
  std::array<double, 2> rhythm_{};  // of the first two harmonics, shares of a performance
};

/// Returns how this person stands when they do nothing.
Controls RestOf(const Person& person);

/// Returns `wanted`, but with no control further outside its joint's range than `authored` is: the deviation shrinks
/// smoothly as it nears the end of the range.
Controls WithinReach(const Controls& wanted, const Controls& authored);

/// The sway of a standing body: weight shifts from foot to foot, the chest breathes, the head looks about.
class Sway {
 public:
  explicit Sway(RandomStream& random);

  /// Returns what the sway adds to a standing body, at a time in seconds after the session's first frame.
  Controls At(double time_s) const;

 private:
  std::array<double, 5> phases_{};
};

}  // namespace etude
