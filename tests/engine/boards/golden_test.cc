// The golden value of finding boards in small and noisy pictures, around every threshold. The other tests of this
// folder check that results are right.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/boards/film_delays.h"
#include "engine/boards/find_boards.h"
#include "engine/boards/printed_board.h"
#include "engine/boards/saddles.h"
#include "tests/support/fingerprint.h"
#include "tests/support/kept_lines.h"

namespace etude {
namespace {

/// A board and its place in a picture.
struct Laid {
  Board board;
  glm::dmat3 to_board;  ///< homography from pixels to points of the board, metres
};

Laid AnyLaid(testing::Dice& dice, const Board& board, const glm::dvec2& middle, double square_px) {
  const double angle = kPi * dice.Signed(), scale = square_px / board.square;
  const double c = scale * std::cos(angle), s = scale * std::sin(angle), narrow = 0.85 + 0.15 * dice.Signed();
  const glm::dvec2 half = 0.5 * board.square * glm::dvec2(board.columns, board.rows);
  const glm::dmat3 centred(1, 0, 0, 0, 1, 0, -half.x, -half.y, 1);
  const glm::dmat3 lean{1.0, 0.0, 0.25 * dice.Signed(), 0.0, 1.0, 0.25 * dice.Signed(), 0.0, 0.0, 1.0};
  const glm::dmat3 turned(c, s, 0, -narrow * s, narrow * c, 0, middle.x, middle.y, 1);
  return {board, glm::inverse(turned * lean * centred)};
}

/// Renders four rays per pixel with blur and noise, and paints over a few modules.
ColourImage Photographed(testing::Dice& dice, const std::vector<Laid>& boards, int width, int height, double noise) {
  ColourImage picture(width, height);
  const std::array<glm::dvec2, 4> rays = {glm::dvec2(0.1, 0.4), {0.6, 0.15}, {0.85, 0.6}, {0.4, 0.9}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      double light = 0;
      for (const glm::dvec2& ray : rays) {
        double seen = 120;
        for (const Laid& laid : boards) {
          const glm::dvec3 p = laid.to_board * glm::dvec3(x + ray.x, y + ray.y, 1);
          const glm::dvec2 place = glm::dvec2(p) / p.z;
          const glm::dvec2 size = laid.board.square * glm::dvec2(laid.board.columns, laid.board.rows);
          if (place.x < 0 || place.y < 0 || place.x >= size.x || place.y >= size.y) continue;
          seen = IsBlackAt(laid.board, place) ? 40 : 210;
        }
        light += seen / 4;
      }
      const auto level = [&] {
        return static_cast<std::uint8_t>(std::clamp(light + noise * dice.Signed(), 0.0, 255.0));
      };
      const std::uint8_t r = level(), g = level();
      picture.At(x, y) = {r, g, level()};
    }
  }
  for (int spot = 0; spot < 5; ++spot) {
    const int left = static_cast<int>(dice.Below(width - 6)), top = static_cast<int>(dice.Below(height - 6));
    const auto level = static_cast<std::uint8_t>(dice.Below(256));
    for (int y = top; y < top + 6; ++y) std::fill_n(&picture.At(left, y), 6, Rgb8{level, level, level});
  }
  return picture;
}

TEST(BoardsGolden, CornersOfPicturesThatAreHardToRead) {
  testing::Dice dice(1);
  testing::Fingerprint print;
  const Board small{.columns = 4, .rows = 5, .square = 0.1},
      large{.columns = 6, .rows = 5, .square = 0.2, .first_code = 30};
  const std::vector<Board> boards = {small, large};
  for (int k = 0; k < 14; ++k) {
    std::vector<Laid> laid = {AnyLaid(dice, k % 2 ? small : large, {110, 90}, 23 + 2 * (k % 6))};
    if (k % 3 == 2) laid.push_back(AnyLaid(dice, k % 2 ? large : small, {190, 120}, 25));
    const ColourImage picture = Photographed(dice, laid, 233, 190, 3.0 * (k % 5));
    for (const Saddle& saddle : FindSaddles(ToGrey(picture))) {
      print.Add(saddle.pixel).Add(saddle.edges[0]).Add(saddle.edges[1]).Add(1e-3 * saddle.strength);
    }
    for (const SeenCorner& seen : FindBoards(picture, boards)) {
      print.Add(seen.board).Add(seen.corner.column).Add(seen.corner.row).Add(seen.pixel);
    }
  }
  EXPECT_TRUE(print.Is(8760, -836.732754849));
}

TEST(FindFilmDelays, SaysWhichCameraShowsNoBoard) {
  EXPECT_EQ(FindFilmDelays(std::vector<PictureSize>(2, PictureSize{640, 480}), {}, std::vector<double>(2, 0.2), 0.1)
                .error()
                .message,
            "no picture of camera 1 shows a board with four corners or more");
}

TEST(PrintedBoard, ComplaintsAreAsTheyWere) {
  testing::ComplaintLines complaints;
  for (const std::string text : {"chess:4x64x0.001", "charuco:64x3x10",
                                 "chess:65x4x1",     "chess:4x65x1",
                                 "chess:3x4x1",      "chess:4x3x1",
                                 "charuco:2x3x1",    "charuco:3x2x1",
                                 "chess:4.5x5x1",    "chess:4x5.5x1",
                                 "chess:4x5x0.0009", "chess:4x5x10.1",
                                 "chess:4x5",        "chess:4x5x",
                                 "chess:4y5x1",      "chess:4x5y1",
                                 "chess:x5x1",       "chess:4x5x1 ",
                                 "charuco:",         "chess",
                                 "charuco4x5x1",     ""}) {
    complaints.Add("'" + text + "'", std::vector{text}, [](const std::string& word) -> Result<PrintedBoard> {
      auto board = ReadPrintedBoard(word);
      if (!board) return Fail({}, "is no printed board");
      return *std::move(board);
    });
  }
  EXPECT_TRUE(testing::AreKept(complaints.lines(), "tests/engine/boards/complaints.txt"));
}

}  // namespace
}  // namespace etude
