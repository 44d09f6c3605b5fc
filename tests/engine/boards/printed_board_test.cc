#include "engine/boards/printed_board.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/cameras/camera.h"
#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a chessboard seen straight on: squares of `size` pixels from (left, top), on white.
ColourImage PictureOfChessboard(const PrintedBoard& board, int size, int left, int top) {
  ColourImage picture(left * 2 + board.columns * size, top * 2 + board.rows * size);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int column = static_cast<int>(std::floor((x - left) / static_cast<double>(size)));
      const int row = static_cast<int>(std::floor((y - top) / static_cast<double>(size)));
      const bool is_on = column >= 0 && row >= 0 && column < board.columns && row < board.rows;
      const std::uint8_t light = is_on && (column + row) % 2 == 0 ? 20 : 230;
      picture.At(x, y) = {light, light, light};
    }
  }
  return picture;
}

/// The first markers of DICT_4X4, row by row, 1 for white, as OpenCV draws them.
constexpr std::array<std::uint16_t, 10> kMarkers = {0xb532, 0x0f9a, 0x332d, 0x9946, 0x549e,
                                                    0x79cd, 0x9e2e, 0xc4f2, 0xfeda, 0xcf56};

/// Returns a ChArUco board with markers in every second square, from the second square or the first one; `is_inverted`
/// exchanges black and white.
ColourImage PictureOfCharuco(const PrintedBoard& board, bool is_inverted, bool is_first) {
  constexpr int kModule = 8, kRim = 8, kSquare = 6 * kModule + 2 * kRim, kLeft = 50, kTop = 40;
  ColourImage picture(2 * kLeft + board.columns * kSquare, 2 * kTop + board.rows * kSquare);
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const int inside_x = x - kLeft, inside_y = y - kTop;
      const int column = inside_x / kSquare, row = inside_y / kSquare;
      bool is_white = true;
      if (inside_x >= 0 && inside_y >= 0 && column < board.columns && row < board.rows) {
        is_white = (column + row) % 2 == (is_first ? 0 : 1);
        const int u = (inside_x % kSquare - kRim) / kModule, v = (inside_y % kSquare - kRim) / kModule;
        const bool is_marker = inside_x % kSquare >= kRim && inside_y % kSquare >= kRim && u < 6 && v < 6;
        if (is_white && is_marker) {
          const bool is_code = u > 0 && v > 0 && u < 5 && v < 5;
          const auto id = static_cast<std::size_t>((row * board.columns + column) / 2);
          is_white = is_code && (kMarkers[id] >> (15 - 4 * (v - 1) - (u - 1)) & 1) != 0;
        }
      }
      const std::uint8_t light = is_white != is_inverted ? 225 : 25;
      picture.At(x, y) = {light, light, light};
    }
  }
  return picture;
}

TEST(PrintedBoard, CornersOfCharucoAreNamedInBothPrintsAndLayouts) {
  const PrintedBoard board{.is_charuco = true, .columns = 5, .rows = 4, .square = 0.03};
  for (const bool is_inverted : {false, true}) {
    for (const bool is_first : {false, true}) {
      SCOPED_TRACE(::testing::Message() << is_inverted << is_first);
      const auto finder = MakePrintedBoardFinder(board);
      if (!finder) GTEST_SKIP() << ToString(finder.error());
      const ColourImage picture = PictureOfCharuco(board, is_inverted, is_first);
      const std::vector<SeenCorner> seen = (*finder)->Find(picture);
      ASSERT_EQ(seen.size(), 12u);
      for (const SeenCorner& each : seen) {
        EXPECT_NEAR(each.pixel.x, 50 + 64 * (each.corner.column + 1), 0.1);
        EXPECT_NEAR(each.pixel.y, 40 + 64 * (each.corner.row + 1), 0.1);
      }
      const std::string told = (*finder)->Told();
      EXPECT_TRUE(told.starts_with("DICT_4X4")) << told;
      EXPECT_EQ(told.find("inverted") != std::string::npos, is_inverted) << told;
      EXPECT_EQ(told.find("a marker in the first square") != std::string::npos, is_first) << told;
      EXPECT_NE(told.find("0.7"), std::string::npos) << told;
      EXPECT_TRUE((*finder)->Find(ColourImage(320, 240)).empty());
    }
  }
}

TEST(PrintedBoard, IsReadFromItsText) {
  const auto chess = ReadPrintedBoard("chess:9x6x0.025");
  ASSERT_TRUE(chess && *chess);
  EXPECT_FALSE((*chess)->is_charuco);
  EXPECT_EQ((*chess)->columns, 9);
  EXPECT_EQ((*chess)->rows, 6);
  EXPECT_EQ((*chess)->square, 0.025);
  const auto charuco = ReadPrintedBoard("charuco:4x5x0.054");
  ASSERT_TRUE(charuco && *charuco);
  EXPECT_TRUE((*charuco)->is_charuco);
  EXPECT_FALSE(ReadPrintedBoard("8x6x0.03"));  // one of ours
  for (const char* wrong : {"chess:", "chess:9x6", "chess:2x6x0.1", "chess:9.5x6x0.1", "chess:9x6x0", "chess:9x6xnan",
                            "charuco:4x5x0.05x1", "charuco:4x65x0.05"}) {
    ASSERT_OK(board, ReadPrintedBoard(wrong)) << wrong;
    EXPECT_FALSE(*board) << wrong;
  }
}

TEST(PrintedBoard, CornersOfAChessboardAreWhereTheyWereDrawn) {
  const PrintedBoard board{.is_charuco = false, .columns = 7, .rows = 6, .square = 0.03};
  constexpr int kSize = 40, kLeft = 60, kTop = 50;
  const auto finder = MakePrintedBoardFinder(board);
  if (!finder) GTEST_SKIP() << ToString(finder.error());
  const std::vector<SeenCorner> seen = (*finder)->Find(PictureOfChessboard(board, kSize, kLeft, kTop));
  ASSERT_EQ(seen.size(), 30u);  // inner corners only
  for (const SeenCorner& each : seen) {
    EXPECT_NEAR(each.pixel.x, kLeft + kSize * (1 + (&each - seen.data()) % 6), 0.1);
    EXPECT_NEAR(each.pixel.y, kTop + kSize * (1 + (&each - seen.data()) / 6), 0.1);
  }
  EXPECT_TRUE((*finder)->Find(ColourImage(320, 240)).empty());
}

/// Returns `picture` warped with bilinear interpolation; the homography `to_source` maps the result's points to those
/// of `picture`.
ColourImage Warped(const ColourImage& picture, const glm::dmat3& to_source, int width, int height) {
  ColourImage warped(width, height, {120, 120, 120});
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 p = to_source * glm::dvec3(x + 0.5, y + 0.5, 1);
      const glm::dvec2 at = glm::dvec2(p) / p.z - 0.5;
      const int i = static_cast<int>(std::floor(at.x)), j = static_cast<int>(std::floor(at.y));
      if (!picture.Contains(i, j) || !picture.Contains(i + 1, j + 1)) continue;
      const double s = at.x - i, t = at.y - j;
      const auto grey =
          static_cast<std::uint8_t>(std::lerp(std::lerp(picture.At(i, j).r, picture.At(i + 1, j).r, s),
                                              std::lerp(picture.At(i, j + 1).r, picture.At(i + 1, j + 1).r, s), t) +
                                    0.5);
      warped.At(x, y) = {grey, grey, grey};
    }
  }
  return warped;
}

/// Checks that every corner of a board in a warped picture is where the warp puts the corner of its column and row.
class WarpedCorners {
 public:
  std::size_t Expect(const std::vector<SeenCorner>& seen, const glm::dmat3& to_source) {
    for (const SeenCorner& each : seen) {
      const glm::dvec3 p = to_source * glm::dvec3(each.pixel, 1);
      EXPECT_NEAR(p.x / p.z, 50 + 64 * (1 + each.corner.column), 0.4);
      EXPECT_NEAR(p.y / p.z, 40 + 64 * (1 + each.corner.row), 0.4);
      sum_ += (1 + each.corner.column) * each.pixel.x + each.pixel.y / (1 + each.corner.row);
    }
    return seen.size();
  }
  /// Returns a weighted sum of all corners. OpenCV's vector code may change its last digits; a changed setting of
  /// OpenCV changes more.
  double sum() const { return sum_; }

 private:
  double sum_ = 0;
};

TEST(PrintedBoard, IsReadAslantUpsideDownAndInPart) {
  const glm::dmat3 aslant(1.05, 0.12, 2e-4, -0.1, 1.1, 1e-4, 8, -20, 1), round(-1, 0, 0, 0, -1, 0, 440, 420, 1);
  const auto half = [](double from) { return glm::dmat3(1, 0, 0, 0, 1, 0, from, 0, 1); };
  WarpedCorners chess_corners, charuco_corners;
  for (const auto& [columns, rows] : {std::pair(5, 4), {4, 5}}) {
    const PrintedBoard chess{.columns = columns, .rows = rows, .square = 0.03}, charuco{true, columns, rows, 0.03};
    const auto of_chess = MakePrintedBoardFinder(chess), of_charuco = MakePrintedBoardFinder(charuco);
    if (!of_chess) GTEST_SKIP() << ToString(of_chess.error());
    const std::size_t all = static_cast<std::size_t>((columns - 1) * (rows - 1));
    for (const glm::dmat3& to_source : {glm::dmat3(1), aslant, round}) {
      const ColourImage squares = Warped(PictureOfChessboard(chess, 64, 50, 40), to_source, 440, 420);
      EXPECT_EQ(chess_corners.Expect((*of_chess)->Find(squares), to_source), all);
      const ColourImage markers = Warped(PictureOfCharuco(charuco, false, false), to_source, 440, 420);
      EXPECT_EQ(charuco_corners.Expect((*of_charuco)->Find(markers), to_source), all);
    }
    EXPECT_EQ((*of_chess)->Told(), "a chessboard");
    EXPECT_EQ((*of_charuco)->Told().substr(0, 27), "DICT_4X4, markers about 0.7");
    for (const double from : {100.0, 150.0, 200.0}) {
      const ColourImage part = Warped(PictureOfCharuco(charuco, false, false), half(from), 440, 420);
      EXPECT_LT(charuco_corners.Expect((*of_charuco)->Find(part), half(from)), all);
    }
  }
  EXPECT_NEAR(chess_corners.sum(), 44109.06, 0.5);
  EXPECT_NEAR(charuco_corners.sum(), 58340.99, 0.5);
  EXPECT_EQ((*MakePrintedBoardFinder({true, 5, 4, 0.03}))->Told(), "found no ArUco marker of any dictionary");
}

/// Boards of 6 × 5 corners in front of a camera with a lens: OpenCV recovers all its parameters.
TEST(CalibrateByOpenCv, FindsEveryNumberOfALens) {
  Camera camera = LookAt({.fx = 610, .fy = 590, .cx = 327, .cy = 231}, {0, 0, -1}, {0, 0, 0});
  camera.distortion = {.k1 = -0.2, .k2 = 0.08, .p1 = 0.003, .p2 = -0.004, .k3 = -0.02};
  std::vector<TargetView> views;
  for (int k = 0; k < 8; ++k) {
    const glm::dvec3 right(std::cos(0.2 * k - 0.7), std::sin(0.1 * k), std::sin(0.2 * k - 0.7));
    const glm::dvec3 down = glm::normalize(glm::cross(glm::dvec3(0.3 * (k % 3) - 0.3, 0.4 * (k % 2) - 0.2, 1), right));
    TargetView& view = views.emplace_back();
    for (int i = 0; i < 30; ++i) {
      const glm::dvec3 place(0.11 * (i % 6), 0.1 * (i / 6), 0);
      const glm::dvec3 at = (place.x - 0.28) * glm::normalize(right) + (place.y - 0.2) * down;
      if (const auto pixel = Project(camera, at)) view.pairs.push_back({place, *pixel});
    }
  }
  const auto found = CalibrateByOpenCv(views, {640, 480}, LensModel::kRadial3);
  if (!found) GTEST_SKIP() << ToString(found.error());
  const Intrinsics& in = found->intrinsics;
  EXPECT_EQ(std::pair(in.width, in.height), std::pair(640, 480));
  for (const auto& [number, wanted] : {std::pair(in.fx, 610), {in.fy, 590}, {in.cx, 327}, {in.cy, 231}, {in.skew, 0}})
    EXPECT_NEAR(number, wanted, 0.05);
  const Distortion &lens = found->distortion, &d = camera.distortion;
  for (const auto& [number, wanted] :
       {std::pair(lens.k1, d.k1), {lens.k2, d.k2}, {lens.p1, d.p1}, {lens.p2, d.p2}, {lens.k3, d.k3}})
    EXPECT_NEAR(number, wanted, 1e-3);
  EXPECT_LT(found->rms_px, 1e-3);
  EXPECT_EQ(CalibrateByOpenCv(views, {640, 480}, LensModel::kRadial2)->distortion.k3, 0);
  const OpenCvCalibration pinhole = *CalibrateByOpenCv(views, {640, 480}, LensModel::kPinhole);
  EXPECT_EQ(pinhole.distortion, Distortion{});
  EXPECT_GT(pinhole.rms_px, 0.3) << "the control";
  EXPECT_EQ(CalibrateByOpenCv(views, {640, 480}, LensModel::kAsInCamera).error().message,
            "OpenCV's calibrateCamera cannot keep the lens distortion of the given camera");
}

}  // namespace
}  // namespace etude
