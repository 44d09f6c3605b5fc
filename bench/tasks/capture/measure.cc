#include "bench/tasks/capture/measure.h"

#include <algorithm>
#include <cmath>

#include "engine/cameras/limb_direction.h"
#include "engine/cameras/triangulation.h"

namespace etude {
namespace {

// Planes nearer to parallel magnify the strokes' errors more than about seven times.
constexpr double kSmallestPlaneAngle = Radians(8);
// A limb seen almost end on: two pixels of error leave nothing of its direction.
constexpr double kShortestStroke = 6;  // pixels

bool IsLongEnough(const PixelSegment& stroke) { return glm::distance(stroke.a, stroke.b) >= kShortestStroke; }

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

FrameMeasurement MeasureFrame(const Marks& marks1, const ProjectionMatrix& matrix1, const Marks& marks2,
                              const ProjectionMatrix& matrix2) {
  FrameMeasurement frame;
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (!marks1.effectors[i] || !marks2.effectors[i]) continue;
    const std::array<Sighting, 2> sightings = {{{matrix1, *marks1.effectors[i]}, {matrix2, *marks2.effectors[i]}}};
    const TriangulatedPoint point = Triangulate(sightings);
    if (point.status == PointStatus::kOk) frame.ends[Index(EffectorMarks()[i].role)] = point.position;
  }
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    const auto &stroke1 = marks1.strokes[i], &stroke2 = marks2.strokes[i];
    if (!stroke1 || !stroke2 || !IsLongEnough(*stroke1) || !IsLongEnough(*stroke2)) continue;
    const LimbDirection limb = ComputeLimbDirection(matrix1, *stroke1, matrix2, *stroke2, kSmallestPlaneAngle);
    if (limb.status == DirectionStatus::kOk) frame.directions[Index(StrokeMarks()[i].to)] = limb.direction;
  }
  return frame;
}

FrameMeasurement TrueMeasurement(const BodyPose& truth) {
  FrameMeasurement frame;
  for (const EffectorMark& mark : EffectorMarks()) frame.ends[Index(mark.role)] = truth[mark.role];
  for (const StrokeMark& mark : StrokeMarks()) {
    const glm::dvec3 limb = truth[mark.to] - truth[mark.from];
    if (glm::length(limb) > 0) frame.directions[Index(mark.to)] = glm::normalize(limb);
  }
  return frame;
}

std::vector<std::optional<LimbObservation>> BridgeGaps(std::span<const FrameMeasurement> frames, int longest_gap) {
  const int count = static_cast<int>(frames.size());
  std::vector<std::optional<LimbObservation>> bridged;
  for (int frame = 0; frame < count; ++frame) {
    LimbObservation observation;
    bool complete = true;
    for (const EffectorMark& mark : EffectorMarks()) {
      auto end_at = [&](int k) { return frames[k].ends[Index(mark.role)]; };
      const auto end = Bridge(frame, count, longest_gap, end_at, MixPoints);
      complete &= end.has_value();
      observation.ends[mark.role] = end.value_or(glm::dvec3(0));
    }
    for (const StrokeMark& mark : StrokeMarks()) {
      auto direction_at = [&](int k) { return frames[k].directions[Index(mark.to)]; };
      const auto direction = Bridge(frame, count, longest_gap, direction_at, SlerpDirections);
      complete &= direction.has_value();
      observation.directions[Index(mark.to)] = direction.value_or(glm::dvec3(0));
    }
    bridged.push_back(complete ? std::optional(observation) : std::nullopt);
  }
  return bridged;
}

}  // namespace etude
