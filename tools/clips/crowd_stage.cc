#include "tools/clips/crowd_stage.h"

#include <cmath>

#include "io/drawing/look.h"
#include "sim/body/shape.h"

namespace etude {
namespace {

constexpr double kApart = 1.6;       // distance between neighbours, metres
constexpr double kBrightness = 1.8;  // the room's brightness, raised because the lamp is far from most characters
constexpr Rgb8 kPale{250, 240, 190};

// Returns a camera that sees the whole square from slightly above; the first row of bodies is nearest to the camera.
Camera CameraOver(std::size_t side, int width, int height) {
  const double depth = kApart * static_cast<double>(side - 1);
  const Intrinsics seen{
      .width = width, .height = height, .fx = 0.86 * width, .fy = 0.86 * width, .cx = 0.5 * width, .cy = 0.5 * height};
  return LookAt(seen, {0, 0.28 * depth + 2, 1.45 * depth + 4}, {0, 0, 0.45 * depth});
}

}  // namespace

CrowdStage::CrowdStage(int characters, int width, int height, Renderer& renderer)
    : width_(width),
      height_(height),
      side_(static_cast<std::size_t>(std::ceil(std::sqrt(characters)))),
      camera_(CameraOver(side_, width, height)),
      renderer_(renderer) {}

glm::dvec3 CrowdStage::GridPointOf(std::size_t character) const {
  const double across = static_cast<double>(character % side_) - 0.5 * static_cast<double>(side_ - 1);
  return {kApart * across, 0, kApart * static_cast<double>(side_ - 1 - character / side_)};
}

Canvas CrowdStage::Draw(std::span<const Character> crowd, const std::string& strong, const std::string& soft) {
  std::vector<Figure> figures;
  PartColours pale;
  pale.fill(kPale);
  for (std::size_t i = 0; i < crowd.size(); ++i) {
    Figure figure{BodyCapsules(crowd[i].pose), crowd[i].stands_out ? pale : PerformerColours()};
    for (Capsule& capsule : figure.shape) {
      capsule.a += GridPointOf(i);
      capsule.b += GridPointOf(i);
    }
    figures.push_back(std::move(figure));
  }
  Canvas canvas(width_, height_);
  const Box whole{0, 0, static_cast<double>(width_), static_cast<double>(height_)};
  canvas.DrawImage(
      renderer_.Render({.brightness = kBrightness, .casts_shadows = false}, figures, camera_, Targets::kColour).colour,
      whole);
  DrawCaption(canvas, whole, strong, soft);
  return canvas;
}

}  // namespace etude
