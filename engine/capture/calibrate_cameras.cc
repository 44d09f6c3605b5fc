#include "engine/capture/calibrate_cameras.h"

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

}  // namespace etude
