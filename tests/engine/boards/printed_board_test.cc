#include "engine/boards/printed_board.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
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
