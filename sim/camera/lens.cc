#include "sim/camera/lens.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"

namespace etude {

Distortion LensDistortion(const CameraEffects& effects, const Intrinsics& in, RandomStream& random) {
  const double direction = random.Uniform(0, 2 * kPi);
  const double across = std::max(in.cx, in.width - in.cx) / in.fx, down = std::max(in.cy, in.height - in.cy) / in.fy;
  const double corner2 = across * across + down * down;
  const double p = effects.tangential_distortion / (3 * std::sqrt(corner2));
  return {.k1 = effects.radial_distortion / corner2, .p1 = p * std::cos(direction), .p2 = p * std::sin(direction)};
}

LensWarp::LensWarp(const Camera& camera)
    : width_(camera.intrinsics.width), height_(camera.intrinsics.height), pinhole_(camera) {
  if (camera.distortion.IsNone()) return;
  pinhole_.distortion = {};
  std::vector<glm::dvec2> places;
  glm::dvec2 low(0), high(width_, height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const glm::dvec2 here(x + 0.5, y + 0.5);
      const auto place = UndistortPixel(camera, here);
      assert(place && "so strong a distortion has no picture");
      places.push_back(place.value_or(here));
      low = glm::min(low, places.back());
      high = glm::max(high, places.back());
    }
  }
  // A pixel more on every side, for the neighbours of the outermost.
  const glm::dvec2 margin = glm::ceil(-low) + 1.0, beyond = glm::ceil(high - glm::dvec2(width_, height_)) + 1.0;
  pinhole_.intrinsics.width += static_cast<int>(margin.x + beyond.x);
  pinhole_.intrinsics.height += static_cast<int>(margin.y + beyond.y);
  pinhole_.intrinsics.cx += margin.x;
  pinhole_.intrinsics.cy += margin.y;
  assert(pinhole_.intrinsics.width <= kLargestPicture && pinhole_.intrinsics.height <= kLargestPicture);

  for (int y = 0; y < height_; ++y) {
    RowRange& rows = source_of_row_.emplace_back(RowRange{pinhole_.intrinsics.height, 0});
    for (int x = 0; x < width_; ++x) {
      const glm::dvec2 centre = places[sources_.size()] + margin - 0.5;
      const glm::dvec2 corner = glm::floor(centre);
      sources_.push_back({static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y),
                          static_cast<float>(centre.x - corner.x), static_cast<float>(centre.y - corner.y)});
      rows.first = std::min(rows.first, sources_.back().y);
      rows.end = std::max(rows.end, sources_.back().y + 2);
    }
  }
}

RowRange LensWarp::SourceRows(const RowRange& rows) const {
  if (sources_.empty()) return rows;
  RowRange all = source_of_row_[static_cast<std::size_t>(rows.first)];
  for (int y = rows.first; y < rows.end; ++y) {
    const RowRange& row = source_of_row_[static_cast<std::size_t>(y)];
    all = {std::min(all.first, row.first), std::max(all.end, row.end)};
  }
  return all;
}

void LensWarp::Warp(const LightImage& source, const RowRange& rows, LightImage& out) const {
  if (sources_.empty()) {
    std::copy(source.pixels.begin(), source.pixels.end(), &out.At(0, rows.first));
    return;
  }
  const int first = SourceRows(rows).first, stride = source.width;
  for (int y = rows.first; y < rows.end; ++y) {
    const Source* from = sources_.data() + static_cast<std::size_t>(y) * width_;
    Light* to = &out.At(0, y);
    for (int x = 0; x < width_; ++x) {
      const Light* upper = source.pixels.data() + static_cast<std::ptrdiff_t>(from[x].y - first) * stride + from[x].x;
      const Light* lower = upper + stride;
      const float right = from[x].right, down = from[x].down;
      const float a = (1 - right) * (1 - down), b = right * (1 - down), c = (1 - right) * down, d = right * down;
      to[x] = {a * upper[0].r + b * upper[1].r + c * lower[0].r + d * lower[1].r,
               a * upper[0].g + b * upper[1].g + c * lower[0].g + d * lower[1].g,
               a * upper[0].b + b * upper[1].b + c * lower[0].b + d * lower[1].b,
               a * upper[0].unused + b * upper[1].unused + c * lower[0].unused + d * lower[1].unused};
    }
  }
}

template <typename Pixel>
void LensWarp::Nearest(const Image<Pixel>& source, const RowRange& rows, Image<Pixel>& out) const {
  if (sources_.empty()) {
    std::copy(source.pixels.begin(), source.pixels.end(), &out.At(0, rows.first));
    return;
  }
  const int first = SourceRows(rows).first;
  for (int y = rows.first; y < rows.end; ++y) {
    const Source* from = sources_.data() + static_cast<std::size_t>(y) * width_;
    for (int x = 0; x < width_; ++x) {
      const int right = from[x].right >= 0.5f ? 1 : 0, down = from[x].down >= 0.5f ? 1 : 0;
      out.At(x, y) = source.At(from[x].x + right, from[x].y + down - first);
    }
  }
}

void LensWarp::Warp(const LabelImage& source, const RowRange& rows, LabelImage& out) const {
  Nearest(source, rows, out);
}
void LensWarp::Warp(const DepthImage& source, const RowRange& rows, DepthImage& out) const {
  Nearest(source, rows, out);
}

}  // namespace etude
