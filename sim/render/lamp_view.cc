#include "sim/render/lamp_view.h"

#include <algorithm>
#include <cmath>

namespace etude {
namespace {

constexpr double kNextToLamp = 1e-3;

RoomTile MakeTile(const PixelRect& pixels, const LampView& view, int width) {
  RoomTile tile{.pixels = pixels};
  std::vector<glm::dvec3> points, directions;
  glm::dvec3 sum(0), low(1e9), high(-1e9);
  for (int y = pixels.top; y < pixels.bottom; ++y) {
    for (int x = pixels.left; x < pixels.right; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const glm::dvec3 from_lamp(view.x[i], view.y[i], view.z[i]);
      const double distance = glm::length(from_lamp);
      tile.farthest = std::max(tile.farthest, distance);
      points.push_back(from_lamp);
      low = glm::min(low, from_lamp);
      high = glm::max(high, from_lamp);
      directions.push_back(from_lamp / std::max(distance, kNextToLamp));
      sum += directions.back();
    }
  }
  const double length = glm::length(sum);
  tile.middle = length > 0 ? sum / length : glm::dvec3(0, 1, 0);
  for (const glm::dvec3& direction : directions) {
    tile.spread = std::max(tile.spread, glm::distance(direction, tile.middle));
  }
  tile.centre = 0.5 * (low + high);
  for (const glm::dvec3& point : points) tile.radius = std::max(tile.radius, glm::distance(point, tile.centre));
  return tile;
}

}  // namespace

LampView SeeFromLamp(const std::vector<float>& depths, const Camera& camera, const glm::dvec3& lamp) {
  const Intrinsics& in = camera.intrinsics;
  const glm::dmat3 R_WC = glm::transpose(camera.R_CW);
  LampView view;
  view.lamp = lamp;
  for (std::vector<float>* part : {&view.x, &view.y, &view.z}) part->reserve(depths.size());
  for (int y = 0; y < in.height; ++y) {
    for (int x = 0; x < in.width; ++x) {
      const double depth = depths[static_cast<std::size_t>(y) * in.width + x];
      const double v = (y + 0.5 - in.cy) / in.fy, u = (x + 0.5 - in.cx - in.skew * v) / in.fx;
      const glm::dvec3 point = std::isfinite(depth) ? camera.p_WC + depth * (R_WC * glm::dvec3(u, v, 1)) - lamp
                                                    : glm::dvec3(0, kNextToLamp, 0);
      view.x.push_back(static_cast<float>(point.x));
      view.y.push_back(static_cast<float>(point.y));
      view.z.push_back(static_cast<float>(point.z));
    }
  }
  for (int top = 0; top < in.height; top += kRoomTileSize) {
    for (int left = 0; left < in.width; left += kRoomTileSize) {
      const PixelRect pixels{left, top, std::min(left + kRoomTileSize, in.width),
                             std::min(top + kRoomTileSize, in.height)};
      const RoomTile tile = MakeTile(pixels, view, in.width);
      if (tile.farthest > 2 * kNextToLamp) view.tiles.push_back(tile);
    }
  }
  return view;
}

}  // namespace etude
