#include <etude/cameras.h>
#include <fmt/format.h>

#include "engine/api/convert.h"
#include "engine/cameras/camera.h"
#include "engine/cameras/dlt.h"
#include "engine/cameras/refine.h"
#include "engine/cameras/rig_file.h"
#include "engine/cameras/triangulation.h"

namespace etude::engine {
Camera FromEngineCamera(std::string name, const etude::Camera& camera) {
  const Intrinsics& in = camera.intrinsics;
  const Distortion& lens = camera.distortion;
  if (lens != Distortion{lens.k1, lens.k2, lens.p1, lens.p2, lens.k3}) {
    throw BadInput(fmt::format(
        "camera '{}': a lens model that is not supported; allowed: Brown and Conrady's (k1, k2, p1, p2, k3)", name));
  }
  return {.name = std::move(name),
          .width = in.width,
          .height = in.height,
          .fx = in.fx,
          .fy = in.fy,
          .cx = in.cx,
          .cy = in.cy,
          .skew = in.skew,
          .k1 = lens.k1,
          .k2 = lens.k2,
          .p1 = lens.p1,
          .p2 = lens.p2,
          .k3 = lens.k3,
          .R_CW = camera.R_CW,
          .p_WC = camera.p_WC};
}

etude::Camera ToEngineCamera(const Camera& camera) {
  return {.intrinsics = {camera.width, camera.height, camera.fx, camera.fy, camera.cx, camera.cy, camera.skew},
          .R_CW = camera.R_CW,
          .p_WC = camera.p_WC,
          .distortion = {camera.k1, camera.k2, camera.p1, camera.p2, camera.k3}};
}

std::vector<Camera> ReadRig(std::string_view text, const std::string& file) {
  std::vector<Camera> cameras;
  for (const NamedCamera& read : OrThrow(etude::ReadRig(text, file))) {
    cameras.push_back(FromEngineCamera(read.name, read.camera));
  }
  return cameras;
}

std::optional<glm::dvec2> Project(const Camera& camera, const glm::dvec3& p_WQ) {
  return etude::Project(ToEngineCamera(camera), p_WQ);
}

CalibratedCamera Calibrate(std::span<const PointPair> pairs, int width, int height) {
  std::vector<etude::PointPair> measured;
  for (const PointPair& pair : pairs) measured.push_back({pair.p_WQ, pair.pixel});
  constexpr int kMaxSide = 100'000;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw BadInput(fmt::format("a picture of {} x {} pixels; allowed: 1 to {} each", width, height, kMaxSide));
  }
  const RefinedRig rig = OrThrow(RefineCamera(measured, width, height));
  return {FromEngineCamera("", rig.cameras.front()), rig.rms_px};
}

std::optional<TriangulatedPoint> Triangulate(std::span<const Camera> cameras,
                                             std::span<const std::optional<glm::dvec2>> pixels) {
  if (pixels.size() != cameras.size()) {
    throw BadInput(fmt::format("{} pixels; allowed: one entry, which may be empty, for each of {} cameras",
                               pixels.size(), cameras.size()));
  }
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const etude::Camera camera = ToEngineCamera(cameras[i]);
    const auto straight = pixels[i] ? UndistortPixel(camera, *pixels[i]) : std::nullopt;
    if (straight) sightings.push_back({MatrixOf(camera), *straight});
  }
  const etude::TriangulatedPoint point = TriangulateByPixels(sightings);
  if (point.status != PointStatus::kOk) return std::nullopt;
  return TriangulatedPoint{point.position, point.residual_px};
}

}  // namespace etude::engine
