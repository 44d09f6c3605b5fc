#include "engine/capture/interpolate_gaps.h"

#include <algorithm>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/directions.h"
#include "engine/vision/strokes.h"

namespace etude {
namespace {

// Interpolates along the great circle between two unit vectors. For nearly equal or opposite vectors it returns the
// vector that is nearer in time.
glm::dvec3 SlerpDirections(const glm::dvec3& from, const glm::dvec3& to, double share) {
  const double angle = AngleBetween(from, to);
  constexpr double kNearlyEqual = 1e-6;
  if (angle < kNearlyEqual || kPi - angle < kNearlyEqual) return share < 0.5 ? from : to;
  return (std::sin((1 - share) * angle) * from + std::sin(share * angle) * to) / std::sin(angle);
}

glm::dvec3 MixPoints(const glm::dvec3& from, const glm::dvec3& to, double share) { return glm::mix(from, to, share); }

/// A quantity at one frame, interpolated between measurements.
struct FilledValue {
  glm::dvec3 value{0};
  int distance = 0;  ///< number of frames to the nearest measurement; 0 if the frame itself was measured
};

// Returns the value at `frame`, interpolated with `mix` between the nearest frames that have a value (`value_at`).
// Returns nullopt if no such frame is within `max_gap` frames.
template <typename ValueAt, typename Mix>
std::optional<FilledValue> Interpolated(int frame, int frames, int max_gap, ValueAt value_at, Mix mix) {
  int before = frame, after = frame;
  while (before >= 0 && !value_at(before)) --before;
  while (after < frames && !value_at(after)) ++after;
  const bool has_before = before >= 0, has_after = after < frames;
  const bool is_near = (has_before && frame - before <= max_gap) || (has_after && after - frame <= max_gap);
  if (!is_near) return std::nullopt;
  const int distance = std::min(has_before ? frame - before : frames, has_after ? after - frame : frames);
  if (!has_after || before == after) return FilledValue{*value_at(before), distance};
  if (!has_before) return FilledValue{*value_at(after), distance};
  const double share = static_cast<double>(frame - before) / (after - before);
  return FilledValue{mix(*value_at(before), *value_at(after), share), distance};
}

// Returns the direction of a limb that is assumed not to be foreshortened: the mean direction of its strokes, from
// beginning to end.
std::optional<glm::dvec3> DirectionAcrossSight(std::span<const StrokePlane> planes) {
  glm::dvec3 sum(0);
  for (const StrokePlane& plane : planes) sum += glm::normalize(plane.ray_b_W - plane.ray_a_W);
  constexpr double kNone = 1e-6;
  const double length = glm::length(sum);
  if (!(length > kNone)) return std::nullopt;
  return sum / length;
}

// Finds the vector d, of any length, that minimises the sum of squares in the comment on `InterpolateGaps`, and returns
// d normalised.
glm::dvec3 FuseDirection(std::span<const StrokePlane> planes, const FilledValue& filled, const GapOptions& options) {
  const double turn = options.turn_per_frame * filled.distance;
  glm::dmat3 squares(1 / (turn * turn));
  const glm::dvec3 wanted = filled.value / (turn * turn);
  for (const StrokePlane& plane : planes) {
    constexpr double kMinError = Radians(1);
    const glm::dvec3 middle = glm::normalize(plane.ray_a_W + plane.ray_b_W);
    const double sine = glm::length(glm::cross(middle, filled.value));
    const double error = std::max(kMinError, std::sqrt(2.0) * options.mark_error_px / plane.length_px * sine);
    squares += glm::outerProduct(plane.normal_W, plane.normal_W) / (error * error);
  }
  const glm::dvec3 direction = glm::inverse(squares) * wanted;
  return UnitOr(direction, filled.value);
}

/// Completes one frame of a take.
class GapFiller {
 public:
  GapFiller(std::span<const FrameMeasurement> frames, int frame, const GapOptions& options)
      : frames_(frames), frame_(frame), options_(options) {}

  std::optional<LimbObservation> Complete() const {
    LimbObservation observation;
    bool is_empty = true;
    for (const EffectorMark& mark : EffectorMarks()) {
      const std::optional<glm::dvec3> end = End(Index(mark.role));
      is_empty &= !end;
      observation.ends[mark.role] = end.value_or(glm::dvec3(0));
      observation.lacks_end[Index(mark.role)] = !end;
    }
    for (const StrokeMark& mark : StrokeMarks()) {
      const std::optional<glm::dvec3> direction = Direction(Index(mark.to));
      is_empty &= !direction;
      observation.directions[Index(mark.to)] = direction.value_or(glm::dvec3(0));
      observation.lacks_direction[Index(mark.to)] = !direction;
    }
    if (is_empty) return std::nullopt;
    return observation;
  }

 private:
  int Count() const { return static_cast<int>(frames_.size()); }

  std::optional<glm::dvec3> End(std::size_t role) const {
    const auto end_at = [&](int k) -> const auto& { return frames_[k].ends[role]; };
    const auto filled = Interpolated(frame_, Count(), options_.max_gap, end_at, MixPoints);
    if (!filled) return std::nullopt;
    const auto& line = frames_[frame_].sight_lines[role];
    return line ? NearestOn(*line, filled->value) : filled->value;
  }

  std::optional<glm::dvec3> Direction(std::size_t role) const {
    const auto direction_at = [&](int k) -> const auto& { return frames_[k].directions[role]; };
    const auto filled = Interpolated(frame_, Count(), options_.max_gap, direction_at, SlerpDirections);
    const std::vector<StrokePlane>& planes = frames_[frame_].planes[role];
    if (!filled) return DirectionAcrossSight(planes);
    if (filled->distance == 0 || planes.empty()) return filled->value;
    return FuseDirection(planes, *filled, options_);
  }

  const std::span<const FrameMeasurement> frames_;
  const int frame_;
  const GapOptions& options_;
};

}  // namespace

std::vector<std::optional<LimbObservation>> InterpolateGaps(std::span<const FrameMeasurement> frames,
                                                            const GapOptions& options) {
  std::vector<std::optional<LimbObservation>> filled;
  for (int k = 0; k < static_cast<int>(frames.size()); ++k) filled.push_back(GapFiller(frames, k, options).Complete());
  return filled;
}

std::optional<LimbObservation> ExtrapolateLast(std::span<const FrameMeasurement> frames, const GapOptions& options) {
  return GapFiller(frames, static_cast<int>(frames.size()) - 1, options).Complete();
}

}  // namespace etude
