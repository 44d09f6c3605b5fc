#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "sim/choreography/controls.h"
#include "sim/performer/fault.h"
#include "sim/performer/style.h"

namespace etude {

/// The duration of the blend from standing into a move, and of the blend from the move back to standing, seconds.
constexpr double kBlendSeconds = 0.45;

/// Returns the performance's own time, seconds, at a time of the session. It equals `time` between 0 and `length`. It
/// accelerates from rest in the blend before and decelerates to rest in the blend after, so motions neither start nor
/// stop abruptly.
inline double EasedTime(double time, double length) {
  if (time < 0) {
    const double t = std::max(time, -kBlendSeconds) + kBlendSeconds;
    return 0.5 * t * t / kBlendSeconds - 0.5 * kBlendSeconds;
  }
  if (time > length) return length - EasedTime(length - time, length);
  return time;
}

/// The random variation of one performance, without its faults. The variation differs between the performances of one
/// person.
struct Chance {
  double lag_s = 0;        ///< delay behind the coach
  double tempo = 1;        ///< factor on the move's tempo
  double unevenness = 0;   ///< unevenness of the timing from the first beat to the last, as a share of the performance
  std::uint64_t ways = 0;  ///< key of the random numbers of the performance's offsets
};

/// Draws the variation of one performance by this person.
Chance DrawChance(RandomStream& random, const Person& person);

/// One performance of a move: the body at each share of the performance, and the share that is reached at each time.
/// The body and the share are available with the performance's faults (danced) and without these faults (meant). Shares
/// and times run from 0 at the first beat to 1 at the last, and continue smoothly beyond.
class Rendition {
 public:
  /// `meant` and `instead` must outlive this object. With the fault kWrongMove, `instead` is danced.
  Rendition(const Style& meant, const Chance& chance, std::vector<GradedFault> faults, const Style* instead = nullptr);

  const Style& style() const { return *meant_; }

  /// Return the body at a share of the performance: Meant returns it without the faults, Danced with the faults.
  /// `vigour` is the share of the amplitude that is left when the person is tired.
  Controls Meant(double share, double vigour = 1) const;
  Controls Danced(double share, double vigour = 1) const;
  /// Returns the weight of the dance: 1 while the person dances, 0 while they stand still.
  double Presence(double share) const;

  /// Return the share of the performance that is reached at time `due`: MeantShare returns it without the faults,
  /// DancedShare with the faults. `due` is the share that a perfectly timed performance has reached at that time. Both
  /// functions increase.
  double MeantShare(double due) const;
  double DancedShare(double due) const;
  /// Returns the delay of the whole performance, as a share of the performance's length.
  double Lateness() const;
  /// Returns the time at which `share` is danced: the inverse of DancedShare.
  double DueOf(double share) const;

  /// Computes the deviation from the intended performance. The deviation is zero without faults.
  PerformanceDeviation Deviation() const;

 private:
  std::optional<GradedFault> Find(Fault fault) const;
  Controls Reordered(double share, double vigour) const;

  const Style* meant_;
  const Style* instead_;
  Chance chance_;
  SmoothOffsets offsets_;
  std::vector<GradedFault> faults_;
};

/// Returns true if this fault alone, at its worst, makes a performance of `move` truly wrong; the person otherwise
/// dances as taught. A move that equals its own mirror image, shifted by half a performance, has no wrong side.
/// `instead` is the move that kWrongMove dances; other faults do not use it.
bool CanShow(const GradedFault& fault, const Move& move, const Move* instead);

/// For each move, the faults that the move can show, which are the same for every person. The search takes some
/// milliseconds per move.
class ShowableFaults {
 public:
  explicit ShowableFaults(std::span<const Move> moves);

  /// Returns the faults of the i-th move at severity 1, one for each variant (`choice`).
  std::span<const GradedFault> Of(std::size_t move) const { return faults_[move]; }

 private:
  std::vector<std::vector<GradedFault>> faults_;
};

}  // namespace etude
