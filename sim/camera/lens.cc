#include "sim/camera/lens.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "engine/base/angles.h"

namespace etude {
namespace {

/// Four floats that the compiler processes in one vector.
using Lanes = float __attribute__((vector_size(16)));
Lanes LoadLanes(const Light* light) {
  Lanes colours;
  std::memcpy(&colours, light, sizeof colours);
  return colours;
}
void StoreLanes(const Lanes& colours, Light* light) {
  std::memcpy(static_cast<void*>(light), &colours, sizeof colours);
}

constexpr int kMaxUnrolled = 6;

/// Rows of floats around a centre row: rows[reach + i] is i rows below the centre row.
using Rows = const float* const*;

/// Computes out[i] = Σ weights[k] · (row −k [i] + row k [i]) over k = 0 … kReach in one pass.
template <int kReach>
void WeighUnrolled(Rows rows, const float* weights, std::size_t count, float* __restrict out) {
  std::array<float, kReach + 1> w;
  std::array<const float*, 2 * kReach + 1> row;
  std::copy_n(weights, w.size(), w.begin());
  std::copy_n(rows, row.size(), row.begin());
  for (std::size_t i = 0; i < count; ++i) {
    float sum = w[0] * (row[kReach][i] + row[kReach][i]);
#pragma GCC unroll 8
    for (int k = 1; k <= kReach; ++k) sum += w[k] * (row[kReach - k][i] + row[kReach + k][i]);
    out[i] = sum;
  }
}

/// Computes the same sums as WeighUnrolled, in the same order of additions, in several passes; allows any reach.
void WeighInPasses(Rows rows, int reach, const float* weights, std::size_t count, float* __restrict out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = weights[0] * (rows[reach][i] + rows[reach][i]);
  for (int k = 1; k <= reach; ++k) {
    const float *before = rows[reach - k], *behind = rows[reach + k];
    for (std::size_t i = 0; i < count; ++i) out[i] += weights[k] * (before[i] + behind[i]);
  }
}

void Weigh(Rows rows, int reach, const float* weights, std::size_t count, float* out) {
  switch (reach) {
    case 1:
      return WeighUnrolled<1>(rows, weights, count, out);
    case 2:
      return WeighUnrolled<2>(rows, weights, count, out);
    case 3:
      return WeighUnrolled<3>(rows, weights, count, out);
    case 4:
      return WeighUnrolled<4>(rows, weights, count, out);
    case 5:
      return WeighUnrolled<5>(rows, weights, count, out);
    case kMaxUnrolled:
      return WeighUnrolled<kMaxUnrolled>(rows, weights, count, out);
    default:
      return WeighInPasses(rows, reach, weights, count, out);
  }
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
  std::vector<glm::dvec2> points;
  // Undistort the centre of every pixel, and find the bounding box of the results.
  glm::dvec2 low(0), high(width_, height_);
  for (int y = 0; y < height_; ++y) {
    for (int x = 0; x < width_; ++x) {
      const glm::dvec2 here(x + 0.5, y + 0.5);
      const auto point = UndistortPixel(camera, here);
      assert(point && "the distortion is too strong to give a picture");
      points.push_back(point.value_or(here));
      low = glm::min(low, points.back());
      high = glm::max(high, points.back());
    }
  }
  // Enlarge the pinhole's picture to the bounding box, and by one more pixel on every side, which interpolation needs.
  const glm::dvec2 margin = glm::ceil(-low) + 1.0, beyond = glm::ceil(high - glm::dvec2(width_, height_)) + 1.0;
  pinhole_.intrinsics.width += static_cast<int>(margin.x + beyond.x);
  pinhole_.intrinsics.height += static_cast<int>(margin.y + beyond.y);
  pinhole_.intrinsics.cx += margin.x;
  pinhole_.intrinsics.cy += margin.y;
  assert(pinhole_.intrinsics.width <= kMaxPictureSide && pinhole_.intrinsics.height <= kMaxPictureSide);

  // Store, for every pixel, its four source pixels and its nearest source pixel. Store, for every row, the rows of the
  // pinhole's picture from which this row is interpolated.
  for (int y = 0; y < height_; ++y) {
    RowRange& rows = source_of_row_.emplace_back(RowRange{pinhole_.intrinsics.height, 0});
    for (int x = 0; x < width_; ++x) {
      const glm::dvec2 centre = points[sources_.size()] + margin - 0.5;
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

View LensWarp::Warp(const View& pinhole) const {
  if (is_none()) return pinhole;
  // Cut out the rows that the warp reads.
  const RowRange all{0, height_}, rows = SourceRows(all);
  const auto rows_of = [&](const auto& picture) {
    std::remove_cvref_t<decltype(picture)> part(picture.width, rows.end - rows.first);
    std::copy_n(&picture.At(0, rows.first), part.pixels.size(), part.pixels.begin());
    return part;
  };
  // Convert colour to light, warp the light, and convert the light back to colour. Labels and depth are copied
  // from the nearest source pixel.
  View view;
  if (!pinhole.colour.pixels.empty()) {
    const ColourImage colour = rows_of(pinhole.colour);
    LightImage light(colour.width, colour.height), warped(width_, height_);
    DecodeRow(colour.pixels.data(), static_cast<int>(colour.pixels.size()), light.pixels.data());
    Warp(light, all, warped);
    view.colour = ColourImage(width_, height_);
    EncodeRow(warped.pixels.data(), width_ * height_, view.colour.pixels.data());
  }
  if (!pinhole.labels.pixels.empty()) {
    view.labels = LabelImage(width_, height_);
    Warp(rows_of(pinhole.labels), all, view.labels);
  }
  if (!pinhole.depth.pixels.empty()) {
    view.depth = DepthImage(width_, height_);
    Warp(rows_of(pinhole.depth), all, view.depth);
  }
  return view;
}

Defocus::Defocus(double sigma_px) {
  const int reach = static_cast<int>(std::ceil(3 * sigma_px));
  std::vector<double> exact;
  double sum = 0;
  for (int i = 0; i <= reach; ++i) {
    exact.push_back(std::exp(-0.5 * i * i / (sigma_px * sigma_px)));
    sum += (i == 0 ? 1 : 2) * exact.back();
  }
  // Halve the weight of the centre, because the centre is added twice.
  exact[0] /= 2;
  for (const double weight : exact) weights_.push_back(static_cast<float>(weight / sum));
}

void Defocus::BlurAcross(const Light* row, std::size_t width, Light* out) {
  const std::size_t reach = weights_.size() - 1;
  padded_row_.resize(width + 2 * reach);
  std::fill_n(padded_row_.begin(), reach, row[0]);
  std::copy_n(row, width, padded_row_.data() + reach);
  std::fill_n(padded_row_.data() + reach + width, reach, row[width - 1]);
  rows_.clear();
  for (std::size_t i = 0; i <= 2 * reach; ++i) rows_.push_back(&padded_row_[i].r);
  Weigh(rows_.data(), static_cast<int>(reach), weights_.data(), 4 * width, &out->r);
}

void Defocus::Apply(LightImage& light) {
  const int reach = static_cast<int>(weights_.size()) - 1, height = light.height, kept = 2 * reach + 1;
  const std::size_t width = static_cast<std::size_t>(light.width);
  // Keep a ring buffer of horizontally blurred rows: as many rows as the blur of one output row needs.
  across_.resize(static_cast<std::size_t>(kept) * width);
  const auto across = [&](int y) { return across_.data() + static_cast<std::size_t>(y % kept) * width; };
  int done = 0;
  for (int y = 0; y < height; ++y) {
    for (; done < std::min(y + reach + 1, height); ++done) BlurAcross(&light.At(0, done), width, across(done));
    rows_.clear();
    for (int i = -reach; i <= reach; ++i) rows_.push_back(&across(std::clamp(y + i, 0, height - 1))->r);
    Weigh(rows_.data(), reach, weights_.data(), 4 * width, &light.At(0, y).r);
  }
}

void AddVignette(const Camera& camera, double strength, Transmission& transmission) {
  const Intrinsics& in = camera.intrinsics;
  for (int y = 0; y < transmission.height; ++y) {
    for (int x = 0; x < transmission.width; ++x) {
      const glm::dvec2 pixel(x + 0.5, y + 0.5);
      const glm::dvec2 straight = UndistortPixel(camera, pixel).value_or(pixel);
      const double across = (straight.x - in.cx) / in.fx, down = (straight.y - in.cy) / in.fy;
      transmission.At(x, y) *= static_cast<float>(std::pow(1 + across * across + down * down, -2 * strength));
    }
  }
}

std::vector<Speck> DrawSpecks(int width, int height, RandomStream& random) {
  constexpr int kSpecks = 10;
  std::vector<Speck> specks;
  for (int i = 0; i < kSpecks; ++i) {
    const double x = random.Uniform(0, width), y = random.Uniform(0, height);
    specks.push_back({x, y, random.Uniform(2, 6)});
  }
  return specks;
}

void AddDust(const std::vector<Speck>& specks, double strength, Transmission& transmission) {
  constexpr double kReach = 6;  // in radii of a speck; at larger distances, the speck's shadow is below a thousandth
  for (const Speck& speck : specks) {
    const int left = std::max(0, static_cast<int>(speck.x - kReach * speck.radius));
    const int top = std::max(0, static_cast<int>(speck.y - kReach * speck.radius));
    const int right = std::min(transmission.width, static_cast<int>(speck.x + kReach * speck.radius) + 1);
    const int bottom = std::min(transmission.height, static_cast<int>(speck.y + kReach * speck.radius) + 1);
    for (int y = top; y < bottom; ++y) {
      for (int x = left; x < right; ++x) {
        const double dx = x + 0.5 - speck.x, dy = y + 0.5 - speck.y;
        const double share = (dx * dx + dy * dy) / (speck.radius * speck.radius);
        transmission.At(x, y) *= static_cast<float>(1 - strength / (1 + share * share));
      }
    }
  }
}

}  // namespace etude
