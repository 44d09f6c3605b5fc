#include "engine/capture/bridge_gaps.h"

#include <cmath>

#include "engine/base/angles.h"
#include "engine/vision/strokes.h"

namespace etude {
namespace {

// Along the great circle from one unit vector to another; straight through when they are opposite.
glm::dvec3 SlerpDirections(const glm::dvec3& from, const glm::dvec3& to, double share) {
  const double angle = AngleBetween(from, to);
  constexpr double kNearlyEqual = 1e-6;
  if (angle < kNearlyEqual || kPi - angle < kNearlyEqual) return share < 0.5 ? from : to;
  return (std::sin((1 - share) * angle) * from + std::sin(share * angle) * to) / std::sin(angle);
}

glm::dvec3 MixPoints(const glm::dvec3& from, const glm::dvec3& to, double share) { return glm::mix(from, to, share); }

// The value at `frame` from the nearest measured ones, which `value_at` gives.
template <typename ValueAt, typename Mix>
std::optional<glm::dvec3> Bridge(int frame, int frames, int longest_gap, ValueAt value_at, Mix mix) {
  int before = frame, after = frame;
  while (before >= 0 && !value_at(before)) --before;
  while (after < frames && !value_at(after)) ++after;
  const bool has_before = before >= 0, has_after = after < frames;
  const bool is_near = (has_before && frame - before <= longest_gap) || (has_after && after - frame <= longest_gap);
  if (!is_near) return std::nullopt;
  if (!has_after || before == after) return value_at(before);
  if (!has_before) return value_at(after);
  return mix(*value_at(before), *value_at(after), static_cast<double>(frame - before) / (after - before));
}

}  // namespace

std::vector<std::optional<LimbObservation>> BridgeGaps(std::span<const FrameMeasurement> frames,
                                                       const BridgeOptions& options) {
  const int count = static_cast<int>(frames.size());
  std::vector<std::optional<LimbObservation>> bridged;
  for (int frame = 0; frame < count; ++frame) {
    LimbObservation observation;
    bool complete = true;
    for (const EffectorMark& mark : EffectorMarks()) {
      auto end_at = [&](int k) { return frames[k].ends[Index(mark.role)]; };
      const auto end = Bridge(frame, count, options.longest_gap, end_at, MixPoints);
      complete &= end.has_value();
      observation.ends[mark.role] = end.value_or(glm::dvec3(0));
    }
    for (const StrokeMark& mark : StrokeMarks()) {
      auto direction_at = [&](int k) { return frames[k].directions[Index(mark.to)]; };
      const auto direction = Bridge(frame, count, options.longest_gap, direction_at, SlerpDirections);
      complete &= direction.has_value();
      observation.directions[Index(mark.to)] = direction.value_or(glm::dvec3(0));
    }
    bridged.push_back(complete ? std::optional(observation) : std::nullopt);
  }
  return bridged;
}

}  // namespace etude
