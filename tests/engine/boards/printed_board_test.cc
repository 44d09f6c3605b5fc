#include "engine/boards/printed_board.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace etude {
namespace {

/// A chessboard seen from straight ahead: squares of `size` pixels from (left, top) on, black and white in turn, on
/// white.
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

/// The first markers of DICT_4X4, modules by rows, 1 for white; as OpenCV draws them.
constexpr std::array<std::uint16_t, 10> kMarkers = {0xb532, 0x0f9a, 0x332d, 0x9946, 0x549e,
                                                    0x79cd, 0x9e2e, 0xc4f2, 0xfeda, 0xcf56};

/// A ChArUco board of markers in every second square: from the second square on, or from the first one; `is_inverted`
/// exchanges black and white of all.
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
    const auto board = ReadPrintedBoard(wrong);
    ASSERT_TRUE(board) << wrong;
    EXPECT_FALSE(*board) << wrong;
  }
}

TEST(PrintedBoard, CornersOfAChessboardAreWhereTheyWereDrawn) {
  const PrintedBoard board{.is_charuco = false, .columns = 7, .rows = 6, .square = 0.03};
  constexpr int kSize = 40, kLeft = 60, kTop = 50;
  const auto finder = MakePrintedBoardFinder(board);
  if (!finder) GTEST_SKIP() << ToString(finder.error());
  const std::vector<SeenCorner> seen = (*finder)->Find(PictureOfChessboard(board, kSize, kLeft, kTop));
  ASSERT_EQ(seen.size(), 30u);  // inner corners alone
  for (const SeenCorner& each : seen) {
    EXPECT_NEAR(each.pixel.x, kLeft + kSize * (1 + (&each - seen.data()) % 6), 0.1);
    EXPECT_NEAR(each.pixel.y, kTop + kSize * (1 + (&each - seen.data()) / 6), 0.1);
  }
  EXPECT_TRUE((*finder)->Find(ColourImage(320, 240)).empty());
}

}  // namespace
}  // namespace etude
