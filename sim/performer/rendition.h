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

/// The length of the way from standing into a move, and back.
constexpr double kBlendSeconds = 0.45;

/// Returns a performance's clock, seconds: it runs with time between 0 and `length`, gathers way in the blend before,
/// and comes to rest in the blend after, so that nothing starts or stops at a jerk.
inline double EasedTime(double time, double length) {
  if (time < 0) {
    const double t = std::max(time, -kBlendSeconds) + kBlendSeconds;
    return 0.5 * t * t / kBlendSeconds - 0.5 * kBlendSeconds;
  }
  if (time > length) return length - EasedTime(length - time, length);
  return time;
}

/// The random part of one performance, faults aside: no two performances of one person are alike.
struct Chance {
  double lag_s = 0;        ///< behind what is seen
  double tempo = 1;        ///< times the move's
  double unevenness = 0;   ///< of the clock between the first beat and the last, share of the performance
  std::uint64_t ways = 0;  ///< the key of its offsets
};

Chance DrawChance(RandomStream& random, const Person& person);

/// A performance of a move: what is danced at each share of it, and its clock; with its faults, and as it was meant.
/// Shares and clock run from 0, the first beat, to 1, the last; both go on smoothly outside.
class Rendition {
 public:
  /// `meant` and `instead` must outlive this. `instead` is danced in place of the move where a fault is kWrongMove.
  Rendition(const Style& meant, const Chance& chance, std::vector<GradedFault> faults, const Style* instead = nullptr);

  const Style& style() const { return *meant_; }

  /// Returns the body at a share of the performance, without its faults and with them.
  Controls Meant(double share, double vigour = 1) const;
  Controls Danced(double share, double vigour = 1) const;
  /// Returns how much of the body takes part: 1, but 0 where the person stands and waits.
  double Presence(double share) const;

  /// Returns the share that is danced when the person's own clock says `due`, which runs evenly from 0 to 1 in a
  /// performance that is in time; without faults and with them. Both rise.
  double MeantShare(double due) const;
  double DancedShare(double due) const;
  /// Returns by how much the clock is late as a whole, in shares of a performance.
  double Lateness() const;
  /// Returns what the clock says when `share` is danced: the inverse of DancedShare.
  double DueOf(double share) const;

  /// Measures how far this strays from what was meant; zero without faults.
  Stray Strays() const;

 private:
  std::optional<GradedFault> Find(Fault fault) const;
  Controls Reordered(double share, double vigour) const;

  const Style* meant_;
  const Style* instead_;
  Chance chance_;
  SmoothOffsets offsets_;
  std::vector<GradedFault> faults_;
};

/// Tells whether a performance of `move` by somebody who dances as taught is truly wrong when only this fault happens,
/// at its worst. A move that is its own mirror image half a performance later has no wrong side. `choice` as in
/// GradedFault; `instead` for kWrongMove.
bool CanShow(const GradedFault& fault, const Move& move, const Move* instead);

/// The faults that each of some moves can show: costly to find (some milliseconds a move), the same for everybody.
class ShowableFaults {
 public:
  explicit ShowableFaults(std::span<const Move> moves);

  /// Returns the faults of the i-th move, each at severity 1, once for every choice that it leaves open.
  std::span<const GradedFault> Of(std::size_t move) const { return faults_[move]; }

 private:
  std::vector<std::vector<GradedFault>> faults_;
};

}  // namespace etude
