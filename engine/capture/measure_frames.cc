#include "engine/capture/measure_frames.h"

#include <algorithm>
#include <cassert>

namespace etude {
namespace {

/// One frame's pictures, and how they are measured.
class FrameMeter {
 public:
  FrameMeter(const MeasureInputs& inputs, std::size_t frame, const MeasureOptions& options)
      : inputs_(inputs), frame_(frame), options_(options) {}

  void MeasureEnds(FrameMeasurement& frame) const {
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      const std::size_t role = Index(EffectorMarks()[i].role);
      const std::vector<Sighting> sightings = SightingsOfEnd(i);
      const TriangulatedPoint point = sightings.size() > 2 ? TriangulateByPixels(sightings) : Triangulate(sightings);
      if (point.status == PointStatus::kOk) {
        frame.ends[role] = point.position;
      } else if (!sightings.empty()) {
        frame.sight_lines[role] = SightLineOf(sightings.front());
      }
    }
  }

  void MeasureDirections(FrameMeasurement& frame) const {
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      const std::size_t role = Index(StrokeMarks()[i].to);
      frame.directions[role] = Direction(i);
      if (!frame.directions[role]) frame.planes[role] = Planes(i);
    }
  }

 private:
  std::vector<Sighting> SightingsOfEnd(std::size_t effector) const {
    std::vector<Sighting> sightings;
    for (std::size_t camera = 0; camera < inputs_.cameras.size(); ++camera) {
      const auto& pixel = MarksOf(camera).effectors[effector];
      if (pixel) sightings.push_back({inputs_.cameras[camera], *pixel});
    }
    return sightings;
  }

  std::optional<glm::dvec3> Direction(std::size_t stroke_mark) const {
    std::vector<LimbSighting> sightings;
    for (std::size_t camera = 0; camera < inputs_.cameras.size(); ++camera) {
      const auto& stroke = MarksOf(camera).strokes[stroke_mark];
      if (stroke && IsLongEnough(*stroke)) sightings.push_back({inputs_.cameras[camera], *stroke});
    }
    const LimbDirection limb = ComputeLimbDirection(sightings, options_.smallest_plane_angle);
    return limb.status == DirectionStatus::kOk ? std::optional(limb.direction) : std::nullopt;
  }

  std::vector<StrokePlane> Planes(std::size_t stroke_mark) const {
    std::vector<StrokePlane> planes;
    for (std::size_t camera = 0; camera < inputs_.cameras.size(); ++camera) {
      const auto& stroke = MarksOf(camera).strokes[stroke_mark];
      const auto plane = stroke ? PlaneOf({inputs_.cameras[camera], *stroke}) : std::nullopt;
      if (plane) planes.push_back(*plane);
    }
    return planes;
  }

  const Marks& MarksOf(std::size_t camera) const { return inputs_.marks[camera][frame_]; }
  bool IsLongEnough(const PixelSegment& stroke) const {
    return glm::distance(stroke.a, stroke.b) >= options_.shortest_stroke_px;
  }

  const MeasureInputs& inputs_;
  const std::size_t frame_;
  const MeasureOptions& options_;
};

}  // namespace

std::vector<FrameMeasurement> MeasureFrames(const MeasureInputs& inputs, const MeasureOptions& options) {
  assert(inputs.cameras.size() >= 2 && inputs.marks.size() == inputs.cameras.size());
  const std::size_t count = inputs.marks[0].size();
  assert(std::ranges::all_of(inputs.marks, [&](const auto& of_camera) { return of_camera.size() == count; }));
  assert(inputs.known.empty() || inputs.known.size() == count);
  std::vector<FrameMeasurement> frames;
  for (std::size_t i = 0; i < count; ++i) {
    const FrameMeter meter(inputs, i, options);
    const KnownMeasurement known = inputs.known.empty() ? KnownMeasurement{} : inputs.known[i];
    FrameMeasurement& frame = frames.emplace_back();
    if (known.ends) {
      frame.ends = *known.ends;
    } else {
      meter.MeasureEnds(frame);
    }
    if (known.directions) {
      frame.directions = *known.directions;
    } else {
      meter.MeasureDirections(frame);
    }
  }
  return frames;
}

}  // namespace etude
