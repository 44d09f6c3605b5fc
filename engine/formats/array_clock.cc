#include "engine/formats/array_clock.h"

#include <string_view>
#include <utility>

#include "engine/formats/row_clock.h"

namespace etude {

Result<ArrayClock> ClockOfArrays(const Npz& arrays, std::size_t frames, const std::string& file) {
  ArrayClock clock;
  ASSIGN_OR_RETURN(clock.rate, RateOfArrays(arrays, file));
  for (const char* name : {"times_s", "time_s", "timestamps_s", "times", "timestamps", "time", "timestamp", "t"}) {
    const NumberArray* times = arrays.Find(name);
    if (times == nullptr) continue;
    const bool may_be_other = std::string_view(name) == "t" && frames == 1;  // a single number may mean anything
    if (times->values.size() == frames && !may_be_other) {
      clock.time_name = name;
      clock.times = times->values;
      return clock;
    }
    if (times->shape.size() != 1 || times->values.size() < 2 || std::string_view(name) == "t") continue;
    return Fail({file},
                "the array {} has {} values, but the positions have {} frames; allowed: one time for each frame", name,
                times->values.size(), frames);
  }
  return clock;
}

Result<MarkerMotion> LayOnClock(MarkerMotion markers, ArrayClock clock, const std::string& file) {
  constexpr double kMinRate_hz = 0.1, kMaxRate_hz = 10'000;
  if (clock.rate) {
    markers.rate_hz = clock.rate->rate_hz;
    if (!(markers.rate_hz >= kMinRate_hz && markers.rate_hz <= kMaxRate_hz)) {
      return Fail({file}, "{} is {:g}; allowed: {:g} to {:g} Hz", clock.rate->name, markers.rate_hz, kMinRate_hz,
                  kMaxRate_hz);
    }
  }
  if (clock.time_name.empty()) return markers;
  MarkerRows rows{.markers = std::move(markers),
                  .times_s = std::move(clock.times),
                  .lines = {},
                  .rate_name = clock.rate ? clock.rate->name : "",
                  .time_name = "the array " + clock.time_name};
  ASSIGN_OR_RETURN(markers, LayOnClock(std::move(rows), file));
  if (!clock.rate && !markers.start_s) {
    return Fail({file},
                "all times in the array {} are equal; allowed: different times in seconds, or the rate as rate_hz",
                clock.time_name);
  }
  return markers;
}

Result<std::optional<double>> EvenRateOf(const Npz& arrays, std::size_t frames, const std::string& file,
                                         std::string& remark) {
  ASSIGN_OR_RETURN(auto clock, ClockOfArrays(arrays, frames, file));
  if (!clock.IsStated()) return std::nullopt;
  // A marker at its frame's number shows whether every frame stays where it is.
  MarkerMotion numbers{.names = {"frame"}, .frames = {}};
  for (std::size_t f = 0; f < frames; ++f) numbers.frames.push_back({glm::dvec3(static_cast<double>(f), 0, 0)});
  const auto unchanged = numbers.frames;
  ASSIGN_OR_RETURN(numbers, LayOnClock(std::move(numbers), clock, file));
  remark = numbers.remark;
  if (numbers.frames == unchanged) return std::optional(numbers.rate_hz);
  return Fail({file}, "{}: {}; allowed: evenly spaced times, or `--rate` (for `etude clip convert`: `--file-rate`)",
              clock.time_name, remark);
}

}  // namespace etude
