#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/metrics/coach.h"
#include "engine/coaching/coach.h"
#include "engine/motion/body.h"

namespace etude {

/// A performance as its player knows it.
struct PlayedPerformance {
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::string faults = "none";  ///< "amplitude+late"
};

/// Who dances before the coach.
class Player {
 public:
  virtual ~Player() = default;

  /// The body's next pose, now that the coach shows this: SkeletonSensor::kAhead frames ahead of what is shown, for
  /// nobody acts at once on what is seen (0.23 s; a simple reaction to something seen takes 0.2 to 0.25 s).
  virtual BodyPose Next(const CoachOutput& shown) = 0;
  /// The latest performance of this repetition of the dance; none when it was not begun.
  virtual std::optional<PlayedPerformance> PerformanceOf(int repetition) const = 0;
  /// Whether patience has run out.
  virtual bool HasGivenUp() const = 0;
  /// The test without a coach, so many performances' time after the session: for every move of the dance the chance to
  /// dance it without a fault; of a player who cannot say, 1 or 0, and no entry for what is neither.
  virtual std::vector<double> TakeTest(int performances_later) = 0;
};

}  // namespace etude
