#include <etude/silhouettes.h>

#include <algorithm>
#include <cmath>

#include "engine/api/checks.h"
#include "engine/kinematics/limb_lengths.h"
#include "engine/silhouettes/track_silhouettes.h"
#include "engine/unmarked/recover_unmarked.h"

namespace etude::engine {
namespace {

constexpr int kMaxMaskSide = 8192;
constexpr double kFittedSide = 640;  ///< longer side, pixels, of the pictures for which the fit's options were chosen

/// Returns the mask with 1 for every pixel other than 0, as the fit expects.
Mask OnesOf(const Mask& mask) {
  if (std::min(mask.width, mask.height) < 1 || std::max(mask.width, mask.height) > kMaxMaskSide) {
    throw BadInput(fmt::format("the mask has {} x {} pixels; allowed: 1 to {} pixels on each side", mask.width,
                               mask.height, kMaxMaskSide));
  }
  Mask made(mask.width, mask.height);
  if (mask.pixels.size() != made.pixels.size()) {
    throw BadInput(
        fmt::format("the mask has {} pixels; allowed: {} x {}", mask.pixels.size(), mask.width, mask.height));
  }
  std::ranges::transform(mask.pixels, made.pixels.begin(), [](std::uint8_t pixel) { return pixel != 0 ? 1 : 0; });
  return made;
}

/// Returns the width of a mask pixel in camera pixels. Throws BadInput if the width is not a whole number.
int PixelOf(const NamedCamera& camera, const Mask& mask) {
  const Intrinsics& picture = camera.camera.intrinsics;
  const int pixel = mask.width > 0 ? picture.width / mask.width : 0;
  if (pixel >= 1 && picture.width == pixel * mask.width && picture.height == pixel * mask.height) return pixel;
  throw BadInput(
      fmt::format("the mask for camera '{2}' has {0} x {1} pixels; allowed: {3} x {4} pixels, or both of these numbers "
                  "divided by the same whole number",
                  mask.width, mask.height, camera.name, picture.width, picture.height));
}

std::vector<ProjectionMatrix> PinholesOf(std::span<const NamedCamera> cameras) {
  std::vector<ProjectionMatrix> matrices;
  for (const NamedCamera& camera : cameras) {
    if (!camera.camera.distortion.IsNone()) {
      throw BadInput(fmt::format("camera '{}' has lens distortion; allowed: pinhole cameras, with undistorted pictures",
                                 camera.name));
    }
    const ProjectionMatrix& matrix = matrices.emplace_back(MatrixOf(camera.camera));
    for (const auto& row : matrix.h) {
      if (std::ranges::all_of(row, [](double number) { return std::isfinite(number); })) continue;
      throw BadInput(fmt::format("camera '{}' has a parameter that is not finite", camera.name));
    }
  }
  return matrices;
}

LimbLengths LengthsOf(const FollowOptions& options) {
  if (options.measured.empty()) {
    if (options.stature_m >= 0.5 && options.stature_m <= 2.5) return AdultLengths(options.stature_m);
    throw BadInput(fmt::format("the stature is {} m; allowed: 0.5 to 2.5 m", options.stature_m));
  }
  Checked({.rate_hz = options.rate_hz, .poses = options.measured});
  const LimbLengths lengths = MeasureLimbLengths(options.measured);
  if (!IsValid(lengths)) throw BadInput("a limb of the poses in 'measured' has no length");
  return lengths;
}

}  // namespace

std::vector<std::optional<BodyPose>> TrackSilhouettes(std::span<const NamedCamera> cameras,
                                                      std::span<const std::vector<Mask>> masks,
                                                      const FollowOptions& options) {
  // Check the numbers of cameras and masks.
  if (cameras.size() < 2 || masks.size() != cameras.size()) {
    throw BadInput(
        fmt::format("found {} cameras, but masks for {} cameras; allowed: two or more cameras, each with masks",
                    cameras.size(), masks.size()));
  }
  if (!(options.rate_hz >= 1 && options.rate_hz <= 1000)) {
    throw BadInput(fmt::format("the rate is {} Hz; allowed: 1 to 1000 Hz", options.rate_hz));
  }
  // Make silhouettes, and scale the cameras to pictures of kFittedSide.
  std::vector<ProjectionMatrix> matrices = PinholesOf(cameras);
  const SilhouetteBody body = MakeSilhouetteBody(LengthsOf(options));
  std::vector<std::vector<Silhouette>> silhouettes;
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (masks[i].empty() || masks[i].size() != masks.front().size()) {
      throw BadInput(fmt::format(
          "one camera has {} masks, but the first camera has {}; allowed: the same number for all cameras, at least 1",
          masks[i].size(), masks.front().size()));
    }
    const Intrinsics& picture = cameras[i].camera.intrinsics;
    const double scale = kFittedSide / std::max({1, picture.width, picture.height});
    for (std::size_t row : {0, 1}) {
      for (double& number : matrices[i].h[row]) number *= scale;
    }
    std::vector<Silhouette>& of_camera = silhouettes.emplace_back();
    for (const Mask& mask : masks[i]) {
      of_camera.push_back(MakeSilhouette(OnesOf(mask), {.mask_pixel = scale * PixelOf(cameras[i], mask)}));
    }
  }
  // Track the body; the limits of change per frame are adapted to the frame rate.
  TrackOptions track;
  track.angle_change *= kJudgedRateHz / options.rate_hz;
  track.position_change_m *= kJudgedRateHz / options.rate_hz;
  const SilhouetteTrack found =
      etude::TrackSilhouettes(body, {.cameras = matrices, .silhouettes = silhouettes, .start = {}}, track);
  std::vector<std::optional<BodyPose>> poses;
  for (const std::optional<SilhouetteFit>& fit : found.frames) {
    poses.emplace_back();
    if (fit) poses.back() = ToBodyPose(found.body, fit->state);
  }
  return poses;
}

}  // namespace etude::engine
