#include "sim/camera/lens.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// Four floats that the compiler computes with at once.
using Lanes = float __attribute__((vector_size(16)));
Lanes LoadLanes(const Light* light) {
  Lanes colours;
  std::memcpy(&colours, light, sizeof colours);
  return colours;
}
void StoreLanes(const Lanes& colours, Light* light) {
  std::memcpy(static_cast<void*>(light), &colours, sizeof colours);
}

}  // namespace

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
      const glm::dvec2 nearest = glm::floor(centre + 0.5);
      nearest_.push_back(static_cast<std::int32_t>(nearest.y) * pinhole_.intrinsics.width +
                         static_cast<std::int32_t>(nearest.x));
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
  const int first = SourceRows(rows).first, stride = source.width;
  const Light* origin = source.pixels.data();
  for (int y = rows.first; y < rows.end; ++y) {
    const Source* from = sources_.data() + static_cast<std::size_t>(y) * width_;
    Light* to = &out.At(0, y);
    for (int x = 0; x < width_; ++x) {
      const Light* upper = origin + (from[x].y - first) * stride + from[x].x;
      const Light* lower = upper + stride;
      const float right = from[x].right, down = from[x].down;
      const Lanes above = LoadLanes(upper) + right * (LoadLanes(upper + 1) - LoadLanes(upper));
      const Lanes below = LoadLanes(lower) + right * (LoadLanes(lower + 1) - LoadLanes(lower));
      StoreLanes(above + down * (below - above), to + x);
    }
  }
}

template <typename Pixel>
void LensWarp::Nearest(const Image<Pixel>& source, const RowRange& rows, Image<Pixel>& out) const {
  if (sources_.empty()) {
    std::copy(source.pixels.begin(), source.pixels.end(), &out.At(0, rows.first));
    return;
  }
  const std::int32_t skipped = SourceRows(rows).first * source.width;
  const std::size_t begin = static_cast<std::size_t>(rows.first) * width_,
                    end = static_cast<std::size_t>(rows.end) * width_;
  for (std::size_t i = begin; i < end; ++i) {
    out.pixels[i] = source.pixels[static_cast<std::size_t>(nearest_[i] - skipped)];
  }
}

void LensWarp::Warp(const LabelImage& source, const RowRange& rows, LabelImage& out) const {
  Nearest(source, rows, out);
}
void LensWarp::Warp(const DepthImage& source, const RowRange& rows, DepthImage& out) const {
  Nearest(source, rows, out);
}

}  // namespace etude
