#include "engine/capture/calibrate_cameras.h"

#include <cassert>

namespace etude {

Result<std::vector<ProjectionMatrix>> CalibrateCameras(std::span<const std::vector<PointPair>> pairs,
                                                       const CalibrationOptions& options) {
  std::vector<ProjectionMatrix> matrices;
  for (const std::vector<PointPair>& of_camera : pairs) {
    const auto matrix = Calibrate(of_camera, options.method);
    if (!matrix) return Fail({}, "camera {}: {}", matrices.size() + 1, matrix.error().message);
    matrices.push_back(*matrix);
  }
  return matrices;
}

Result<std::vector<Camera>> RefineCameras(std::span<const std::vector<PointPair>> pairs,
                                          std::span<const PictureSize> sizes, const RefineOptions& options) {
  assert(pairs.size() == sizes.size());
  std::vector<Camera> cameras;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto rig = RefineCamera(pairs[i], sizes[i].width, sizes[i].height, options);
    if (!rig) return Fail({}, "camera {}: {}", i + 1, rig.error().message);
    cameras.push_back(rig->cameras.front());
  }
  return cameras;
}

Marks UndistortMarks(const Camera& camera, const Marks& marks) {
  if (camera.distortion.IsNone()) return marks;
  Marks out;
  for (std::size_t i = 0; i < kStrokeCount; ++i) {
    if (!marks.strokes[i]) continue;
    const auto a = UndistortPixel(camera, marks.strokes[i]->a), b = UndistortPixel(camera, marks.strokes[i]->b);
    if (a && b) out.strokes[i] = PixelSegment{*a, *b};
  }
  for (std::size_t i = 0; i < kEffectorCount; ++i) {
    if (marks.effectors[i]) out.effectors[i] = UndistortPixel(camera, *marks.effectors[i]);
  }
  return out;
}

}  // namespace etude
