#include "sim/depth_camera/depth_camera.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>
#include <vector>

#include "sim/depth_camera/normals.h"

namespace etude {
namespace {

/// Returns true if the depths of two neighbouring pixels (metres) belong to different surfaces: the depths differ by
/// more than 3 % of the smaller depth, or exactly one depth is missing (infinite).
bool IsDepthEdge(double a, double b) {
  if (std::isinf(a) || std::isinf(b)) return std::isinf(a) != std::isinf(b);
  return std::abs(a - b) > 0.03 * (a < b ? a : b);
}

/// One row of the picture's pixels, with the column of each pixel in the projector's picture.
class Row {
 public:
  Row(const DepthImage& depth, const Camera& camera, double baseline_m, int y)
      : y_(y), depth_(depth), pixels_(static_cast<std::size_t>(depth.width)) {
    const Intrinsics& in = camera.intrinsics;
    for (int x = 0; x < depth.width; ++x) {
      const auto pixel = UndistortPixel(camera, {x + 0.5, y + 0.5});
      Pixel& made = pixels_[static_cast<std::size_t>(x)];
      made.disparity = in.fx * baseline_m / depth.At(x, y);
      made.camera_column = pixel ? pixel->x : x + 0.5;
      max_disparity_ = std::max(max_disparity_, made.disparity);
    }
    for (int x = 0; x < depth.width; ++x) SetExtent(x);
  }

  /// Returns true if the surface of a nearer pixel blocks the projector's light on its way to the centre of pixel x. A
  /// blocking pixel is to the right of x, by the difference of the disparities of the two pixels.
  bool IsUnlit(int x) const {
    const Pixel& here = pixels_[static_cast<std::size_t>(x)];
    const double column = here.ProjectorColumn();
    for (std::size_t i = static_cast<std::size_t>(x) + 1; i < pixels_.size(); ++i) {
      const Pixel& other = pixels_[i];
      if (other.first - max_disparity_ > column) break;
      if (other.disparity > here.disparity && other.from <= column && column < other.to) return true;
    }
    return false;
  }

 private:
  struct Pixel {
    double camera_column = 0, disparity = 0;
    double first = 0;         ///< left border of the pixel in the camera's picture
    double from = 0, to = 0;  ///< range of the projector's columns that the pixel covers
    double ProjectorColumn() const { return camera_column - disparity; }
  };

  // Computes a pixel's extent: on either side up to the middle between this pixel and its neighbour on the same
  // surface, or half a pixel at an edge.
  void SetExtent(int x) {
    Pixel& pixel = pixels_[static_cast<std::size_t>(x)];
    const auto border = [&](int side) {
      const int next = x + side;
      if (!depth_.Contains(next, y_) || IsDepthEdge(depth_.At(x, y_), depth_.At(next, y_))) {
        return pixel.ProjectorColumn() + 0.5 * side;
      }
      return (pixel.ProjectorColumn() + pixels_[static_cast<std::size_t>(next)].ProjectorColumn()) / 2;
    };
    const auto [from, to] = std::minmax({border(-1), border(1)});
    pixel.first = pixel.camera_column - 0.5;
    pixel.from = from;
    pixel.to = to;
  }

  int y_;
  const DepthImage& depth_;
  std::vector<Pixel> pixels_;
  double max_disparity_ = 0;  ///< the largest disparity of the row
};

constexpr double kRightAngle = std::numbers::pi / 2;
// The largest angle to which LateralDeviationPx is applied: the limit of the published measurements.
constexpr double kMeasuredAngle = 80 * std::numbers::pi / 180;

/// Computes for each pixel the angle between the normal of the pixel's surface and the pixel's line of sight, radians;
/// 0 if the pixel has no normal.
Image<double> AnglesOfSight(const DepthImage& depth, const Camera& camera) {
  const NormalImage normals = NormalsOf(depth, camera);
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  Image<double> angles(depth.width, depth.height, 0);
  for (int y = 0; y < depth.height; ++y) {
    for (int x = 0; x < depth.width; ++x) {
      const glm::dvec3 normal(normals.At(x, y));
      const auto pixel = UndistortPixel(camera, {x + 0.5, y + 0.5});
      if (!pixel || normal == glm::dvec3(0)) continue;
      const double down = (pixel->y - in.cy) / in.fy, across = (pixel->x - in.cx - in.skew * down) / in.fx;
      const glm::dvec3 ray = glm::normalize(R_WC * glm::dvec3(across, down, 1));
      angles.At(x, y) = std::acos(std::clamp(std::abs(glm::dot(normal, ray)), 0.0, 1.0));
    }
  }
  return angles;
}

/// Simulates the measurement of one picture.
class Exposure {
 public:
  Exposure(const DepthImage& truth, const Camera& camera, const DepthCameraOptions& options)
      : options_(options),
        angles_(AnglesOfSight(truth, camera)),
        echo_(truth),
        pixels_per_sensor_pixel_(camera.intrinsics.fx / options.focal_px) {
    const Mask unlit = ProjectorShadow(truth, camera, options.shadows * options.baseline_m);
    const double largest_angle = kRightAngle - options.grazing * (kRightAngle - options.largest_angle);
    for (std::size_t i = 0; i < echo_.pixels.size(); ++i) {
      if (unlit.pixels[i] || angles_.pixels[i] > largest_angle) echo_.pixels[i] = kNotMeasured;
    }
  }

  float Measure(int x, int y, const std::array<double, 3>& normals) const {
    const double z = Rounded(WithNoise(Displaced(x, y, normals[0], normals[1]), normals[2]));
    const bool is_near = z < options_.range * options_.near_m;
    const bool is_far = z * options_.range > options_.far_m;
    return z > 0 && !is_near && !is_far ? static_cast<float>(z) : kNotMeasured;
  }

 private:
  // Returns the depth after lateral noise. Only edges shift; away from edges a pixel keeps its own depth and gets axial
  // noise only.
  double Displaced(int x, int y, double right, double down) const {
    const double own = echo_.At(x, y);
    const double angle = std::min(angles_.At(x, y), kMeasuredAngle);
    const double sigma = options_.lateral_noise * LateralDeviationPx(angle) * pixels_per_sensor_pixel_;
    const int column = x + static_cast<int>(std::lround(sigma * right));
    const int row = y + static_cast<int>(std::lround(sigma * down));
    if (!echo_.Contains(column, row)) return own;
    const double other = echo_.At(column, row);
    return IsDepthEdge(own, other) ? other : own;
  }

  // Adds axial noise to a depth. A disparity step s is a depth step of s z² / (f b). Rounding to depth steps adds the
  // variance (depth step)² / 12. The published law includes this variance, so this variance is subtracted here.
  double WithNoise(double z, double normal) const {
    if (std::isinf(z)) return z;
    const double step = HasSteps() ? Step() * z * z / Focus() : 0;
    const double law = DepthDeviation(options_.law, z);
    return z + options_.axial_noise * std::sqrt(std::max(0.0, law * law - step * step / 12)) * normal;
  }

  double Rounded(double z) const {
    if (!HasSteps() || std::isinf(z) || z <= 0) return z;
    return Focus() / (std::round(Focus() / z / Step()) * Step());
  }

  bool HasSteps() const { return Focus() > 0 && Step() > 0; }
  double Focus() const { return options_.focal_px * options_.baseline_m; }
  double Step() const { return options_.steps * options_.disparity_step_px; }

  const DepthCameraOptions& options_;
  const Image<double> angles_;
  DepthImage echo_;  ///< the true depth where light returns, kNotMeasured elsewhere
  const double pixels_per_sensor_pixel_;
};

}  // namespace

Mask ProjectorShadow(const DepthImage& depth, const Camera& camera, double baseline_m) {
  Mask unlit(depth.width, depth.height);
  if (baseline_m == 0) return unlit;
  for (int y = 0; y < depth.height; ++y) {
    const Row row(depth, camera, baseline_m, y);
    for (int x = 0; x < depth.width; ++x) {
      if (std::isfinite(depth.At(x, y))) unlit.At(x, y) = row.IsUnlit(x);
    }
  }
  return unlit;
}

DepthCameraOptions KinectV1Depth(bool near_mode) {
  DepthCameraOptions options;
  if (near_mode) {
    options.near_m = 0.4;
    options.far_m = 3.0;
  }
  return options;
}

DepthCameraOptions KinectV2Depth() {
  return {.law = DepthLaw::kTimeOfFlight, .focal_px = 365, .baseline_m = 0, .near_m = 0.5, .far_m = 4.5};
}

double LateralDeviationPx(double angle) { return 0.8 + 0.035 * angle / (kRightAngle - angle); }

DepthImage MeasureDepth(const DepthImage& truth, const Camera& camera, const DepthCameraOptions& options,
                        RandomStream& random) {
  assert(options.grazing >= 0 && options.grazing <= 1 && options.range >= 0);
  const Exposure exposure(truth, camera, options);
  DepthImage measured(truth.width, truth.height);
  for (int y = 0; y < truth.height; ++y) {
    for (int x = 0; x < truth.width; ++x) {
      const std::array<double, 3> normals{random.Normal(), random.Normal(), random.Normal()};
      measured.At(x, y) = exposure.Measure(x, y, normals);
    }
  }
  return measured;
}

}  // namespace etude
