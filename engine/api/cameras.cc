#include <etude/cameras.h>
#include <fmt/format.h>

#include "engine/api/checks.h"
#include "engine/cameras/refine.h"
#include "engine/cameras/rig_file.h"

namespace etude::engine {

std::vector<NamedCamera> ReadRig(std::string_view text, const std::string& file) {
  return OrThrow(etude::ReadRig(text, file));
}

CalibratedCamera Calibrate(std::span<const PointPair> pairs, int width, int height) {
  constexpr int kMaxSide = 100'000;
  if (width < 1 || height < 1 || width > kMaxSide || height > kMaxSide) {
    throw BadInput(
        fmt::format("the picture has {} x {} pixels; allowed: 1 to {} pixels on each side", width, height, kMaxSide));
  }
  const RefinedRig rig = OrThrow(RefineCamera(pairs, width, height));
  return {rig.cameras.front(), rig.rms_px};
}

TriangulatedPoint Triangulate(std::span<const NamedCamera> cameras, std::span<const std::optional<glm::dvec2>> pixels) {
  if (pixels.size() != cameras.size()) {
    throw BadInput(
        fmt::format("found {} entries for {} cameras; allowed: one entry for each camera, either a pixel or empty",
                    pixels.size(), cameras.size()));
  }
  std::vector<Sighting> sightings;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    const auto straight = pixels[i] ? UndistortPixel(cameras[i].camera, *pixels[i]) : std::nullopt;
    if (straight) sightings.push_back({MatrixOf(cameras[i].camera), *straight});
  }
  return TriangulateByPixels(sightings);
}

}  // namespace etude::engine
