#include "engine/cameras/rig_doubts.h"

#include <fmt/format.h>

#include <cmath>

namespace etude {
namespace {

bool HasPicture(const Camera& camera) { return camera.intrinsics.width > 0 && camera.intrinsics.height > 0; }

bool IsInPicture(const Intrinsics& in, const glm::dvec2& pixel) {
  return pixel.x >= 0 && pixel.y >= 0 && pixel.x <= in.width && pixel.y <= in.height;
}

/// Returns true if the principal point is far from the picture's middle, but would be the middle of a picture with the
/// same shape and another size.
bool IsMiddleOfAnotherSize(const Intrinsics& in) {
  constexpr double kFar = 0.12, kSameShape = 0.05;  // shares of the width and the height
  const double right = in.cx / in.width - 0.5, down = in.cy / in.height - 0.5;
  return std::abs(right) > kFar && std::abs(right - down) < kSameShape;
}

/// Returns true if a place in the picture of `one` is also in the picture of `other`. The places lie on the rays of a
/// grid of pixels, at distances from a tenth to a hundred times the distance between the cameras.
bool SharesAPlace(const Camera& one, const Camera& other) {
  constexpr int kSide = 9, kDepths = 301;
  constexpr double kNearest = 0.1, kFactor = 1.023292992280754;  // 300 steps make a factor of 1000
  const double apart = glm::distance(one.p_WC, other.p_WC);
  if (apart == 0) return true;
  const Intrinsics& in = one.intrinsics;
  const ProjectionMatrix to_other = MatrixOf(other);
  for (int row = 0; row < kSide; ++row) {
    for (int column = 0; column < kSide; ++column) {
      const glm::dvec2 share((column + 0.5) / kSide, (row + 0.5) / kSide);
      const auto pixel = UndistortPixel(one, share * glm::dvec2(in.width, in.height));
      if (!pixel) continue;
      const double y = (pixel->y - in.cy) / in.fy;
      const glm::dvec3 ray_W = glm::transpose(one.R_CW) * glm::dvec3((pixel->x - in.cx - in.skew * y) / in.fx, y, 1);
      double depth = apart * kNearest;
      for (int i = 0; i < kDepths; ++i, depth *= kFactor) {
        const auto straight = Project(to_other, one.p_WC + depth * ray_W);
        const auto seen = straight ? DistortPixel(other, *straight) : std::nullopt;
        if (seen && IsInPicture(other.intrinsics, *seen)) return true;
      }
    }
  }
  return false;
}

}  // namespace

std::vector<std::string> RigDoubts(std::span<const NamedCamera> cameras) {
  std::vector<std::string> doubts;
  for (const auto& [name, camera] : cameras) {
    const Intrinsics& in = camera.intrinsics;
    if (!HasPicture(camera)) continue;
    if (!IsInPicture(in, {in.cx, in.cy})) {
      doubts.push_back(fmt::format(
          "{}: the principal point ({:.0f}, {:.0f}) is outside the picture of {} x {} pixels; this is right only if "
          "the picture was cropped",
          name, in.cx, in.cy, in.width, in.height));
    } else if (IsMiddleOfAnotherSize(in)) {
      doubts.push_back(fmt::format(
          "{}: the principal point ({:.0f}, {:.0f}) is the middle of a picture of {:.0f} x {:.0f} pixels, not of {} x "
          "{}; was the camera calibrated with pictures of another size?",
          name, in.cx, in.cy, 2 * in.cx, 2 * in.cy, in.width, in.height));
    }
  }
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    bool has_partner = cameras.size() < 2 || !HasPicture(cameras[i].camera);
    for (std::size_t j = 0; j < cameras.size() && !has_partner; ++j) {
      const Camera &one = cameras[i].camera, &other = cameras[j].camera;
      has_partner = i != j && (!HasPicture(other) || SharesAPlace(one, other) || SharesAPlace(other, one));
    }
    if (has_partner) continue;
    doubts.push_back(fmt::format(
        "{}: the field of view of this camera does not overlap with any other camera's; its rotation may be from "
        "camera to world instead of from world to camera, or its axes may point right, up and backwards",
        cameras[i].name));
  }
  return doubts;
}

}  // namespace etude
