#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "sim/camera/camera_model.h"

namespace etude {

inline constexpr WorldKey kShotWorld{.suite_seed = 7, .scenario = "camera", .trial = 0};

inline CameraEffects NoEffects() { return {.noise = 0}; }

inline Camera PlainCamera(int width = 640, int height = 480) {
  return LookAt({.width = width, .height = height, .cx = width / 2.0, .cy = height / 2.0}, {0, 1, 4}, {0, 1, 0});
}

inline CameraModel ModelOf(const CameraEffects& effects, Camera camera = PlainCamera(), bool is_reference = true) {
  RandomStream lens(kShotWorld, "camera/lens");
  camera.distortion = LensDistortion(effects, camera.intrinsics, lens);
  return {camera, effects, 30, {kShotWorld, "camera", is_reference}};
}

/// A scene: the colour of each pixel of the pinhole camera at a time.
using Painter = std::function<Rgb8(int x, int y, double frame)>;

inline CameraModel::Scene SceneOf(const CameraModel& model, Painter painter) {
  const int width = model.pinhole().intrinsics.width;
  return [=](double frame, const RowRange& rows, Targets) {
    View view{.colour = ColourImage(width, rows.end - rows.first), .labels = LabelImage(width, rows.end - rows.first)};
    view.depth = DepthImage(width, rows.end - rows.first, 1.0f);
    for (int y = rows.first; y < rows.end; ++y) {
      for (int x = 0; x < width; ++x) view.colour.At(x, y - rows.first) = painter(x, y, frame);
    }
    return view;
  };
}

inline ColourImage Shoot(CameraModel& model, const Painter& painter, std::size_t frame = 0) {
  return model.Shoot(frame, SceneOf(model, painter), Targets::kColour).colour;
}

inline ColourImage ShootFlat(CameraModel& model, Rgb8 colour, std::size_t frame = 0) {
  return Shoot(
      model, [=](int, int, double) { return colour; }, frame);
}

/// Returns a colour's value as linear light; `colour` is 'r', 'g' or 'b'.
inline double LightAt(const ColourImage& picture, int x, int y, char colour = 'g') {
  const Rgb8& pixel = picture.At(x, y);
  return LightOfCodes()[colour == 'r' ? pixel.r : colour == 'g' ? pixel.g : pixel.b];
}

/// The least-squares line through points: y = intercept + slope · x.
struct Line {
  double slope = 0, intercept = 0;
};
inline Line FitLine(const std::vector<std::pair<double, double>>& points) {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const auto& [px, py] : points) {
    n += 1;
    x += px;
    y += py;
    xx += px * px;
    xy += px * py;
  }
  const double slope = (n * xy - x * y) / (n * xx - x * x);
  return {slope, (y - slope * x) / n};
}

}  // namespace etude
