#include "engine/boards/board_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

#include "tests/support/results.h"

namespace etude {
namespace {

const Board kBoard{.columns = 6, .rows = 5, .square = 0.15, .first_code = 3};

Camera LookingAt(const glm::dvec3& from) {
  return LookAt({.width = 640, .height = 480, .fx = 620, .fy = 620, .cx = 320, .cy = 240, .skew = 0}, from, {0, 0, 0});
}

struct Placed {
  glm::dvec3 corner, right, down;
};

/// Renders each pixel as the mean of nine rays to the board's plane.
ColourImage Photograph(const Camera& camera, const Placed& board) {
  const Intrinsics& in = camera.intrinsics;
  const glm::dvec3 normal = glm::cross(board.right, board.down);
  ColourImage picture(in.width, in.height);
  for (int i = 0; i < in.width * in.height; ++i) {
    double sum = 0;
    for (int k = 0; k < 9; ++k) {
      const glm::dvec2 pixel(i % in.width + (k + 0.5) / 9, i / in.width + (k * 4 % 9 + 0.5) / 9);
      const glm::dvec3 ray =
          glm::transpose(camera.R_CW) * glm::dvec3((pixel.x - in.cx) / in.fx, (pixel.y - in.cy) / in.fy, 1);
      const double depth = glm::dot(board.corner - camera.p_WC, normal) / glm::dot(ray, normal);
      const glm::dvec3 on = camera.p_WC + depth * ray - board.corner;
      const glm::dvec2 place(glm::dot(on, board.right), glm::dot(on, board.down));
      const bool is_on = depth > 0 && place.x >= 0 && place.y >= 0 && place.x < kBoard.columns * kBoard.square &&
                         place.y < kBoard.rows * kBoard.square;
      sum += !is_on ? 120 : IsBlackAt(kBoard, place) ? 35 : 215;
    }
    const auto grey = static_cast<std::uint8_t>(sum / 9 + 0.5);
    picture.pixels[static_cast<std::size_t>(i)] = {grey, grey, grey};
  }
  return picture;
}

Placed Tilted(double yaw, double pitch) {
  const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
  const glm::dvec3 down(std::sin(pitch) * -std::sin(yaw), -std::cos(pitch), std::sin(pitch) * std::cos(yaw));
  return {-0.45 * right - 0.375 * down, right, down};
}

/// The first board hangs upright on a wall, so its rig can be compared with the truth.
TEST(BoardViews, PicturesOfBoardsGiveTwoCamerasBack) {
  const std::vector<Camera> cameras{LookingAt({0.2, 0.3, 1.9}), LookingAt({1.1, 0.2, 1.6})};
  const Placed boards[] = {Tilted(0, 0), Tilted(0.4, 0.3), Tilted(-0.3, 0.4), Tilted(0.2, -0.4), Tilted(0.5, -0.2)};
  BoardViews views({kBoard});
  for (std::size_t moment = 0; moment < std::size(boards); ++moment) {
    for (std::size_t c = 0; c < 2; ++c) {
      ASSERT_OK(corners, views.Add(c, std::to_string(moment), Photograph(cameras[c], boards[moment])));
      EXPECT_GT(*corners, 10u) << moment << ", " << c;
    }
  }
  EXPECT_EQ(*views.Add(0, "empty", ColourImage(640, 480, {90, 90, 90})), 0u) << "nothing in an empty picture";
  const auto other_size = views.Add(0, "small", ColourImage(320, 240, {90, 90, 90}));
  EXPECT_EQ(other_size.error().message,
            "this picture has 320 x 240 pixels, but earlier pictures of the same camera have 640 x 480");
  auto rig = CalibrateFromPlanes(views.sizes(), views.views());
  ASSERT_TRUE(rig) << ToString(rig.error());
  EXPECT_LT(rig->rms_px, 0.15);
  AlignToBoard(BoardPlacement::kOnWall, rig->cameras);
  for (std::size_t c = 0; c < 2; ++c) {
    EXPECT_NEAR(rig->cameras[c].intrinsics.fx, 620, 6);
    EXPECT_LT(glm::distance(rig->cameras[c].p_WC + boards[0].corner, cameras[c].p_WC), 0.03) << c;
  }
}

TEST(AlignToBoard, LaysTheFirstBoardOnTheFloor) {
  std::vector<Camera> cameras{LookAt({}, {0, 0.5, -2}, {0, 0, 0})};
  // In the board's frame: a point one square to the right and two down; and a point one metre in front.
  const glm::dvec3 on(0.2, 0.4, 0), before(0, 0, -1);
  const auto at = Project(cameras[0], on), above = Project(cameras[0], before);
  AlignToBoard(BoardPlacement::kOnFloor, cameras);
  EXPECT_LT(glm::distance(*Project(cameras[0], {0.2, 0, 0.4}), *at), 1e-9);
  EXPECT_LT(glm::distance(*Project(cameras[0], {0, 1, 0}), *above), 1e-9);
}

}  // namespace
}  // namespace etude
