#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/npz.h"
#include "engine/formats/trc.h"

namespace etude {

/// The frame rate and the times that the arrays of an .npz file state.
struct ArrayClock {
  std::optional<ArrayRate> rate = {};
  std::string time_name = "";      ///< the array that gives `times`; "" if there is none
  std::vector<double> times = {};  ///< one time per frame, in the file's unit

  bool IsStated() const { return rate || !time_name.empty(); }
};
/// Finds the rate (RateOfArrays) and the times of a motion of `frames` frames; times are an array `times`,
/// `timestamps`, `time` or `t`, also with `_s`. Fails if an array that is named like times has another number of
/// values.
Result<ArrayClock> ClockOfArrays(const Npz& arrays, std::size_t frames, const std::string& file);

/// Places positions on frames by the clock's times; without times, only sets the rate, if it is stated. Fails if the
/// rate is not 0.1 to 10,000 Hz, if all times are equal and no rate is stated, or if LayOnClock of MarkerRows fails.
Result<MarkerMotion> LayOnClock(MarkerMotion markers, ArrayClock clock, const std::string& file);

/// Returns the rate of a motion of rotations; nullopt if the arrays state neither rate nor times. Times overrule the
/// rate. `remark` receives what LayOnClock says. Fails like LayOnClock, and if the times are uneven, because rotations
/// are not interpolated.
Result<std::optional<double>> EvenRateOf(const Npz& arrays, std::size_t frames, const std::string& file,
                                         std::string& remark);

}  // namespace etude
