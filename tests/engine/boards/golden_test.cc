// Golden values of whole results, of small and noisy pictures about every threshold: whatever changes a corner is
// noticed. What is right is said by the tests beside.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "engine/base/angles.h"
#include "engine/boards/film_steps.h"
#include "engine/boards/find_boards.h"
#include "engine/boards/find_disc.h"
#include "engine/boards/printed_board.h"
#include "engine/boards/saddles.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

TEST(BoardsGolden, Codes) {
  Fingerprint print;
  for (int code = 0; code < kCodeCount; ++code) print.Add(CodeOf(code)).Add(Turned(CodeOf(code)));
  for (const Board& board : {Board{}, Board{.columns = 5, .rows = 3, .square = 0.25, .first_code = 20}}) {
    print.Add(CountCodes(board)).Add(PlaceOf(board, {1, 2}));
    for (int y = -3; y < 60; ++y) {
      for (int x = -3; x < 60; ++x) print.Add(IsBlackAt(board, board.square / 12 * glm::dvec2(x + 0.5 * (y % 2), y)));
    }
  }
  EXPECT_TRUE(print.Is(8184, -4992.59358458));
}

/// A board laid into a picture: its plane's point p is shown at (H p) / w.
struct Laid {
  Board board;
  glm::dmat3 to_board;  ///< of pixels
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

/// Four rays a pixel, blurred by noise; a few modules are painted over.
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

void AddSaddles(Fingerprint& print, const GreyImage& grey) {
  for (const Saddle& saddle : FindSaddles(grey)) {
    print.Add(saddle.pixel).Add(saddle.edges[0]).Add(saddle.edges[1]).Add(1e-3 * saddle.strength);
  }
}

TEST(BoardsGolden, CornersOfPicturesThatAreHardToRead) {
  testing::Dice dice(1);
  Fingerprint saddles, corners, grey;
  const Board small{.columns = 4, .rows = 5, .square = 0.1},
      large{.columns = 6, .rows = 5, .square = 0.2, .first_code = 30};
  const std::vector<Board> boards = {small, large};
  for (int k = 0; k < 14; ++k) {
    std::vector<Laid> laid = {AnyLaid(dice, k % 2 ? small : large, {110, 90}, 23 + 2 * (k % 6))};
    if (k % 3 == 2) laid.push_back(AnyLaid(dice, k % 2 ? large : small, {190, 120}, 25));
    const ColourImage picture = Photographed(dice, laid, 233, 190, 3.0 * (k % 5));
    const GreyImage image = ToGrey(picture);
    AddSaddles(saddles, image);
    for (const SeenCorner& seen : FindBoards(picture, boards)) {
      corners.Add(seen.board).Add(seen.corner.column).Add(seen.corner.row).Add(seen.pixel);
    }
    for (int i = 0; i < 50; ++i) {
      grey.Add(BrightnessAt(image, glm::dvec2(233, 190) * (0.5 + 0.6 * glm::dvec2(dice.Vector()))));
    }
  }
  for (int k = 0; k < 10; ++k) {
    GreyImage waves(14 + 3 * k, 15 + 2 * k);
    for (int y = 0; y < waves.height; ++y) {
      for (int x = 0; x < waves.width; ++x) {
        waves.At(x, y) =
            static_cast<float>(120 + (3 + 9 * k) * std::sin(0.4 * x) * std::cos(0.35 * y + 0.1 * x) + dice.Signed());
      }
    }
    AddSaddles(saddles, waves);
  }
  EXPECT_TRUE(saddles.Is(7308, 3062.91885831));
  EXPECT_TRUE(corners.Is(1375, 2333.95402128));
  EXPECT_TRUE(grey.Is(700, 1853.95418916));
}

TEST(BoardsGolden, DiscsOfEveryKind) {
  testing::Dice dice(2);
  Fingerprint print;
  for (int k = 0; k < 400; ++k) {
    GreyImage picture(41, 33);
    const glm::dvec2 middle = glm::dvec2(20, 16) + (k % 4 ? 6.0 : 19.0) * glm::dvec2(dice.Vector());
    const glm::dvec2 half = glm::dvec2(3.5, 2.5) + (k % 3 ? 1.0 : 2.4) * glm::dvec2(dice.Vector());
    const double contrast = k % 5 ? 100 : 20 + 8 * dice.Signed(), bite = k % 7 == 1 ? 0.6 + 0.3 * dice.Signed() : 9;
    for (int y = 0; y < picture.height; ++y) {
      for (int x = 0; x < picture.width; ++x) {
        const glm::dvec2 p = (glm::dvec2(x + 0.5, y + 0.5) - middle) / half;
        const double edge = std::clamp(
            0.5 + 3 * std::max(glm::length(p) - 1, bite * 0.9 - glm::length(p - glm::dvec2(bite, 0))), 0.0, 1.0);
        picture.At(x, y) = static_cast<float>(60 + contrast * edge + 2 * dice.Signed() + 0.1 * x);
      }
    }
    const glm::dvec2 pointer = middle + 6.0 * glm::dvec2(dice.Vector());
    print.Add(FindDisc(picture, pointer, 2 + k % 6, 6 + k % 9));
  }
  EXPECT_TRUE(print.Is(820, 69.8488307365));
}

/// What cameras see of a board of 4 × 5 squares that is waved about, each later by so many seconds; some sightings and
/// corners are missing.
std::vector<BoardSighting> WavedBoard(testing::Dice& dice, std::size_t cameras, int looks, double period_s,
                                      double late_s) {
  std::vector<BoardSighting> sightings;
  for (std::size_t c = 0; c < cameras; ++c) {
    const Camera camera = LookAt({.fx = 700, .fy = 690}, {0.5 - 0.6 * c, 0.2, -1.1 + 0.1 * c}, {0, 0, 0});
    for (int look = 0; look < looks; ++look) {
      if (dice.Below(9) == 0) continue;
      BoardSighting s{.view = {.camera = c, .target = static_cast<std::size_t>(look), .pairs = {}}, .look = look};
      const double t = 1.5 * (look * period_s - late_s * c), yaw = 0.6 * std::sin(1.3 * t),
                   pitch = 0.5 * std::sin(1.9 * t + 1);
      const glm::dvec3 right(std::cos(yaw), 0, std::sin(yaw));
      const glm::dvec3 down(std::sin(pitch) * std::sin(yaw), std::cos(pitch), -std::sin(pitch) * std::cos(yaw));
      for (int i = 0; i < (looks > 60 ? 5 : 12); ++i) {
        if (dice.Below(12) == 0) continue;
        const glm::dvec2 place(0.054 * (i % 3 + 1), 0.054 * (i / 3 + 1)), off = 0.2 * glm::dvec2(dice.Vector());
        const glm::dvec3 at = 0.1 * glm::dvec3(std::sin(t), std::cos(t), std::sin(2 * t));
        s.view.pairs.push_back(
            {{place.x, place.y, 0}, *Project(camera, at + (place.x - 0.11) * right + (place.y - 0.13) * down) + off});
      }
      sightings.push_back(s);
    }
  }
  return sightings;
}

TEST(BoardsGolden, FilmsInStep) {
  testing::Dice dice(3);
  Fingerprint views, steps;
  for (int k = 0; k < 5; ++k) {
    const std::size_t cameras = k == 1 ? 3 : 2;
    auto sightings = WavedBoard(dice, cameras, k > 2 ? 62 : 8 + k, 0.2, k == 2 ? 0 : 0.13);
    if (k == 4) {  // no moment is told to be the same
      for (BoardSighting& s : sightings) s.view.target += 1000 * s.view.camera;
    }
    const std::array<double, 3> periods = {0.2, k == 2 ? 0.13 : 0.2, 0.2}, late = {0, 0.13, k % 2 ? 0.05 : -0.31};
    for (const TargetView& view :
         ViewsInStep(sightings, std::span(periods).first(cameras), std::span(late).first(cameras))) {
      views.Add(view.camera).Add(view.target);
      for (const PointPair& pair : view.pairs) views.Add(pair.world).Add(pair.pixel);
    }
    const std::vector<PictureSize> sizes(cameras, PictureSize{640, 480});
    std::size_t told = 0, of = 0;
    const auto found = FindFilmSteps(sizes, sightings, std::span(periods).first(cameras), k > 2 ? 0.01 : 0.11 + 0.1 * k,
                                     {}, [&](std::size_t done, std::size_t all) { told += done, of = all; });
    steps.Add(found.has_value()).Add(told).Add(of);
    if (!found) continue;
    steps.Add(found->late_s).Add(std::isfinite(found->before_px) ? found->before_px : -1).Add(found->after_px);
  }
  EXPECT_EQ(FindFilmSteps(std::vector<PictureSize>(2, PictureSize{640, 480}), {}, std::vector<double>(2, 0.2), 0.1)
                .error()
                .message,
            "camera 1 shows no board with four corners or more");
  EXPECT_TRUE(views.Is(8695, 14160.8191398));
  EXPECT_TRUE(steps.Is(31, -989.216759218));
}

TEST(BoardsGolden, WordsOfBoards) {
  Fingerprint print;
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
    const auto board = ReadPrintedBoard(text);
    print.Add(board.has_value());
    if (!board) continue;
    if (*board) print.Add((*board)->is_charuco).Add((*board)->columns).Add((*board)->rows).Add((*board)->square);
    if (!*board) print.Add(board->error().message);
  }
  EXPECT_TRUE(print.Is(1742, 2746.4490482));
}

}  // namespace
}  // namespace etude
