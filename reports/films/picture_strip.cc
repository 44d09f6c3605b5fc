#include "reports/films/picture_strip.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>

#include "bench/files/files.h"
#include "reports/films/film.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

constexpr std::size_t kShownCameras = 2;

// Both cameras at one third and two thirds of the capture.
std::array<int, 2> StripFrames(const CapturePanel& capture) { return {capture.Frames() / 3, capture.Frames() * 2 / 3}; }

}  // namespace

std::vector<Picture> DrawStrip(const CapturePanel& capture, Renderer& renderer) {
  std::vector<Picture> strip;
  for (const int frame : StripFrames(capture)) {
    for (std::size_t camera = 0; camera < std::min(kShownCameras, capture.Cameras()); ++camera) {
      Canvas canvas(480, 360);
      capture.Draw(canvas, renderer, camera, frame);
      strip.push_back(
          PictureOf(canvas, fmt::format("{}, {:.1f} s", capture.CameraName(camera), frame / capture.RateHz())));
    }
  }
  return strip;
}

Result<void> SaveStripPictures(const CapturePanel& capture, Renderer& renderer, const std::filesystem::path& folder) {
  RETURN_IF_ERROR(MakeFolder(folder));
  for (const int frame : StripFrames(capture)) {
    for (std::size_t camera = 0; camera < std::min(kShownCameras, capture.Cameras()); ++camera) {
      const std::string name = fmt::format("camera-{}-frame-{:03}.exr", camera + 1, frame);
      auto saved = SaveExr(capture.Seen(renderer, camera, frame, Targets::kAll), (folder / name).string());
      if (!saved) return saved;
    }
  }
  return {};
}

}  // namespace etude
