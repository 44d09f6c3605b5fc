#include "engine/capture/measure_frames.h"

#include <algorithm>
#include <cassert>

#include "engine/cameras/robust_triangulation.h"

namespace etude {
namespace {

/// Removes a mark of one frame from every picture in which it disagrees with the other pictures. `mark_of(camera)`
/// returns a reference to the mark.
template <typename View, typename MarkOf>
void KeepAgreeing(std::span<const ProjectionMatrix> cameras, double tolerance_px, const MarkOf& mark_of) {
  std::vector<View> views;
  std::vector<std::size_t> by;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    if (!mark_of(camera)) continue;
    views.push_back({cameras[camera], *mark_of(camera)});
    by.push_back(camera);
  }
  const std::vector<std::size_t> kept = AgreeingViews(views, tolerance_px);
  for (std::size_t view = 0; view < views.size(); ++view) {
    if (!std::ranges::binary_search(kept, view)) mark_of(by[view]).reset();
  }
}

/// Measures the marks of one frame.
class FrameMeasurer {
 public:
  FrameMeasurer(const MeasureInputs& inputs, std::size_t frame, const MeasureOptions& options)
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
    const LimbDirection limb = ComputeLimbDirection(sightings, options_.min_plane_angle);
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
    return glm::distance(stroke.a, stroke.b) >= options_.min_stroke_px;
  }

  const MeasureInputs& inputs_;
  const std::size_t frame_;
  const MeasureOptions& options_;
};

}  // namespace

std::vector<std::vector<Marks>> AgreeingMarks(std::span<const ProjectionMatrix> cameras,
                                              std::span<const std::vector<Marks>> marks, double tolerance_px) {
  std::vector<std::vector<Marks>> agreeing(marks.begin(), marks.end());
  for (std::size_t frame = 0; frame < agreeing.front().size(); ++frame) {
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      KeepAgreeing<Sighting>(
          cameras, tolerance_px, [&](std::size_t camera) -> auto& { return agreeing[camera][frame].effectors[i]; });
    }
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      KeepAgreeing<LimbSighting>(
          cameras, tolerance_px, [&](std::size_t camera) -> auto& { return agreeing[camera][frame].strokes[i]; });
    }
  }
  return agreeing;
}

std::vector<FrameMeasurement> MeasureFrames(const MeasureInputs& inputs, const MeasureOptions& options) {
  assert(inputs.cameras.size() >= 2 && inputs.marks.size() == inputs.cameras.size());
  const std::size_t count = inputs.marks[0].size();
  assert(std::ranges::all_of(inputs.marks, [&](const auto& of_camera) { return of_camera.size() == count; }));
  assert(inputs.known.empty() || inputs.known.size() == count);
  std::vector<FrameMeasurement> frames;
  for (std::size_t i = 0; i < count; ++i) {
    const FrameMeasurer measurer(inputs, i, options);
    const KnownMeasurement known = inputs.known.empty() ? KnownMeasurement{} : inputs.known[i];
    FrameMeasurement& frame = frames.emplace_back();
    if (known.ends) {
      frame.ends = *known.ends;
    } else {
      measurer.MeasureEnds(frame);
    }
    if (known.directions) {
      frame.directions = *known.directions;
    } else {
      measurer.MeasureDirections(frame);
    }
  }
  return frames;
}

}  // namespace etude
