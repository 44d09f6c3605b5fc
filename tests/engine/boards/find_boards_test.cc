#include "engine/boards/find_boards.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "engine/base/angles.h"
#include "engine/boards/board_views.h"
#include "engine/boards/printed_board.h"
#include "engine/cameras/camera.h"
#include "sim/random/stream.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::IsEmpty;

/// A board's pose: its top left corner and its two axes in the world.
struct Standing {
  glm::dvec3 corner, right, down;

  glm::dvec3 At(const glm::dvec2& place) const { return corner + place.x * right + place.y * down; }
  glm::dvec3 Normal() const { return glm::cross(right, down); }
};

struct Shown {
  Board board;
  Standing standing;
  bool is_chess = false;  ///< a chessboard without codes
};

/// The part of a picture that contains the boards, with a margin; only this part is rendered.
struct Around {
  int left = 0, top = 0, right = 0, bottom = 0;

  bool Holds(int x, int y) const { return x >= left && x < right && y >= top && y < bottom; }
};

Around PartWith(const std::vector<Shown>& boards, const Camera& camera) {
  constexpr double kMore = 8;  // a lens bends the edges
  const Intrinsics& inside = camera.intrinsics;
  glm::dvec2 low(inside.width, inside.height), high(0, 0);
  for (const Shown& shown : boards) {
    for (const glm::dvec2 at : {glm::dvec2(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      const glm::dvec2 size = shown.board.square * glm::dvec2(shown.board.columns, shown.board.rows);
      const auto pixel = Project(camera, shown.standing.At(at * size));
      if (!pixel) return {0, 0, inside.width, inside.height};
      low = glm::min(low, *pixel - kMore);
      high = glm::max(high, *pixel + kMore);
    }
  }
  return {static_cast<int>(low.x), static_cast<int>(low.y), static_cast<int>(high.x), static_cast<int>(high.y)};
}

/// A second implementation of pictures: each pixel is the mean of 25 rays to the boards' planes. The rays have 25
/// different offsets along each axis; a lattice of 5 × 5 rays would render upright and level edges in steps of a fifth.
ColourImage Photograph(const std::vector<Shown>& boards, const Camera& camera, double noise, RandomStream& random) {
  constexpr int kRays = 25;
  const Intrinsics& inside = camera.intrinsics;
  const Around part = PartWith(boards, camera);
  ColourImage picture(inside.width, inside.height);
  for (int y = 0; y < inside.height; ++y) {
    for (int x = 0; x < inside.width; ++x) {
      double sum = part.Holds(x, y) ? 0 : 120 * kRays;
      // Distortion is nearly constant within a pixel.
      const glm::dvec2 middle(x + 0.5, y + 0.5);
      const glm::dvec2 bent = camera.distortion.IsNone() ? middle : *UndistortPixel(camera, middle);
      for (int k = 0; k < kRays && part.Holds(x, y); ++k) {
        const glm::dvec2 within((k + 0.5) / kRays - 0.5, (k * 7 % kRays + 0.5) / kRays - 0.5);
        const glm::dvec2 pixel = bent + within;
        const glm::dvec3 ray_C((pixel.x - inside.cx) / inside.fx, (pixel.y - inside.cy) / inside.fy, 1);
        const glm::dvec3 ray = glm::transpose(camera.R_CW) * ray_C;
        double light = 120;  // a grey room
        for (const Shown& shown : boards) {
          const glm::dvec3 from = shown.standing.corner - camera.p_WC;
          const double depth = glm::dot(from, shown.standing.Normal()) / glm::dot(ray, shown.standing.Normal());
          if (!(depth > 0)) continue;
          const glm::dvec3 on = camera.p_WC + depth * ray - shown.standing.corner;
          const glm::dvec2 place(glm::dot(on, shown.standing.right), glm::dot(on, shown.standing.down));
          const Board& board = shown.board;
          if (place.x < 0 || place.y < 0 || place.x > board.columns * board.square ||
              place.y > board.rows * board.square) {
            continue;
          }
          const bool is_black = shown.is_chess ? IsBlackSquare(static_cast<int>(place.x / board.square),
                                                               static_cast<int>(place.y / board.square))
                                               : IsBlackAt(board, place);
          light = is_black ? 35 : 215;
        }
        sum += light;
      }
      const double value = sum / kRays + noise * random.Normal();
      const auto grey = static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0));
      picture.At(x, y) = {grey, grey, grey};
    }
  }
  return picture;
}

/// Returns a board `distance` in front of the camera at the origin, turned by `roll` in its plane, by `slant` out of
/// it.
Standing Before(const Board& board, double distance, double roll, double slant) {
  const glm::dvec3 right(std::cos(roll) * std::cos(slant), std::sin(roll), std::cos(roll) * std::sin(slant));
  glm::dvec3 down(-std::sin(roll) * std::cos(slant), std::cos(roll), -std::sin(roll) * std::sin(slant));
  const glm::dvec2 half = 0.5 * board.square * glm::dvec2(board.columns, board.rows);
  return {glm::dvec3(0, 0, distance) - half.x * right - half.y * down, right, down};
}

const Camera kCamera{};  // at the origin, looking along +Z, Y down

struct Outcome {
  int found = 0;
  double rms = 0, worst = 0;
};

Outcome Compare(const std::vector<SeenCorner>& seen, const std::vector<Shown>& boards) {
  Outcome outcome;
  std::set<std::tuple<std::size_t, int, int>> names;
  for (const SeenCorner& corner : seen) {
    const Shown& shown = boards[corner.board];
    const auto pixel = Project(MatrixOf(kCamera), shown.standing.At(PlaceOf(shown.board, corner.corner)));
    const double error = glm::distance(*pixel, corner.pixel);
    outcome.rms += error * error;
    outcome.worst = std::max(outcome.worst, error);
    ++outcome.found;
    EXPECT_TRUE(names.insert({corner.board, corner.corner.column, corner.corner.row}).second) << "named twice";
  }
  outcome.rms = std::sqrt(outcome.rms / std::max(outcome.found, 1));
  return outcome;
}

std::vector<Board> BoardsOf(const std::vector<Shown>& shown) {
  std::vector<Board> boards;
  for (const Shown& one : shown) boards.push_back(one.board);
  return boards;
}

/// A second implementation of calibration, OpenCV's, which minimises the same sum over the same corners.
TEST(FindBoards, RenderedBoardsCalibrateACameraAsOpenCvDoes) {
  Camera camera{.intrinsics = {.width = 400, .height = 300, .fx = 390, .fy = 386, .cx = 207, .cy = 146, .skew = 0}};
  camera.distortion = {.k1 = -0.12, .k2 = 0.05, .p1 = 0.001, .p2 = -0.0015};
  const PrintedBoard printed{.is_charuco = false, .columns = 7, .rows = 6, .square = 0.12};
  const Board board{.columns = 7, .rows = 6, .square = 0.12, .first_code = 11};
  for (const bool is_chess : {false, true}) {
    SCOPED_TRACE(is_chess ? "a chessboard" : "our own");
    auto finder = MakePrintedBoardFinder(printed);
    if (!finder) GTEST_SKIP() << ToString(finder.error());
    BoardViews search = is_chess ? BoardViews(printed, std::move(*finder)) : BoardViews({board});
    RandomStream random({}, "noise");
    for (int i = 0; i < 6; ++i) {
      Standing standing = Before(board, 1.2 + 0.1 * (i % 3), Radians(20 * i - 50), Radians(i % 2 == 0 ? 35 : -30));
      standing.corner += glm::dvec3(0.08 * (i % 3 - 1), 0.06 * (i % 2), 0);
      ASSERT_TRUE(search.Add(0, std::to_string(i), Photograph({{board, standing, is_chess}}, camera, 2, random)));
    }
    const std::vector<TargetView> views = search.views();
    ASSERT_GE(views.size(), 5u);
    ASSERT_OK(ours, CalibrateFromPlanes(search.sizes(), views));
    ASSERT_OK(theirs, CalibrateByOpenCv(views, search.sizes()[0], LensModel::kRadial2));
    EXPECT_NEAR(ours->rms_px, theirs->rms_px, 1e-5);  // OpenCV stores corners as floats
    EXPECT_LT(ours->rms_px, 0.2);
    const Intrinsics &a = ours->cameras[0].intrinsics, &b = theirs->intrinsics;
    for (const auto side : {&Intrinsics::fx, &Intrinsics::fy, &Intrinsics::cx, &Intrinsics::cy}) {
      EXPECT_NEAR(a.*side, b.*side, 0.01);
      if (!is_chess) {
        EXPECT_NEAR(a.*side, camera.intrinsics.*side, 0.015 * camera.intrinsics.fx);
      }
    }
    EXPECT_NEAR(ours->cameras[0].distortion.k1, theirs->distortion.k1, 1e-4);
    ASSERT_OK(pinhole, CalibrateByOpenCv(views, search.sizes()[0], LensModel::kPinhole));
    EXPECT_GT(pinhole->rms_px, ours->rms_px + 0.05) << "the control: without the lens";
    EXPECT_FALSE(CalibrateByOpenCv(views, search.sizes()[0], LensModel::kAsInCamera));
    EXPECT_FALSE(CalibrateByOpenCv({}, search.sizes()[0], LensModel::kRadial2)) << "its complaint, not its end";
  }
}

TEST(Codes, DifferFromEachOtherHoweverTheyAreTurned) {
  for (int a = 0; a < kCodeCount; ++a) {
    std::uint16_t turned = CodeOf(a);
    for (int quarters = 0; quarters < 4; ++quarters, turned = Turned(turned)) {
      for (int b = 0; b < kCodeCount; ++b) {
        if (a == b && quarters == 0) continue;
        EXPECT_GE(std::popcount(static_cast<std::uint16_t>(turned ^ CodeOf(b))), kCodeDistance);
      }
    }
    EXPECT_EQ(turned, CodeOf(a)) << "four quarters are a whole turn";
  }
}

TEST(Codes, TurnClockwise) {
  EXPECT_EQ(Turned(0b1000'0000'0000'0000), 0b0001'0000'0000'0000) << "top left goes to the top right";
  EXPECT_EQ(Turned(0b0100'0000'0000'0000), 0b0000'0001'0000'0000);
}

TEST(Board, NumbersItsWhiteSquaresInRows) {
  for (const int columns : {5, 8}) {
    const Board board{.columns = columns, .rows = 6, .square = 0.1, .first_code = 7};
    int next = 7;
    for (int row = 0; row < board.rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        EXPECT_EQ(IsBlackAt(board, board.square * glm::dvec2(column + 0.05, row + 0.05)), IsBlackSquare(column, row));
        if (IsBlackSquare(column, row)) continue;
        EXPECT_EQ(CodeNumberOf(board, column, row), next++);
      }
    }
    EXPECT_EQ(next, 7 + CountCodes(board));
  }
}

TEST(FindBoards, FindsEveryCornerToATenthOfAPixelHoweverTheBoardIsTurned) {
  RandomStream random({}, "noise");
  for (const double roll : {0.0, 30.0, 90.0, 170.0, -120.0}) {
    for (const double slant : {0.0, 35.0, -50.0}) {
      const Board board{.columns = 7, .rows = 6, .square = 0.12, .first_code = 11};
      const std::vector<Shown> shown{{board, Before(board, 1.6, Radians(roll), Radians(slant))}};
      const Outcome outcome = Compare(FindBoards(Photograph(shown, kCamera, 2, random), BoardsOf(shown)), shown);
      EXPECT_GE(outcome.found, 29) << roll << " " << slant;  // of 30 corners
      EXPECT_LT(outcome.rms, 0.1) << roll << " " << slant;
      EXPECT_LT(outcome.worst, 0.5) << roll << " " << slant;
    }
  }
}

TEST(FindBoards, TellsTwoBoardsApartAndReadsAPartOfOne) {
  RandomStream random({}, "noise");
  const Board first{.columns = 5, .rows = 5, .square = 0.13, .first_code = 0};
  const Board second{.columns = 8, .rows = 8, .square = 0.2, .first_code = CountCodes(first)};
  Standing left = Before(first, 2, Radians(10), Radians(20)), right = Before(second, 2.4, 0, Radians(-30));
  left.corner.x -= 0.5;
  right.corner.x += 1.1;  // its right half is outside the picture
  const std::vector<Shown> shown{{first, left}, {second, right}};
  const auto seen = FindBoards(Photograph(shown, kCamera, 2, random), BoardsOf(shown));
  const Outcome outcome = Compare(seen, shown);
  EXPECT_LT(outcome.worst, 0.5);
  const auto of_first = std::ranges::count(seen, 0u, &SeenCorner::board);
  EXPECT_GE(of_first, 15);  // of 16 corners
  EXPECT_GE(outcome.found - of_first, 15);
  EXPECT_LT(outcome.found - of_first, 49) << "corners outside the picture";
}

TEST(FindBoards, NamesNothingThatItsCodesDoNotTell) {
  RandomStream random({}, "noise");
  const Board board{.columns = 7, .rows = 6, .square = 0.12, .first_code = 0};
  const std::vector<Shown> shown{{board, Before(board, 1.6, 0.3, 0.2)}};
  const ColourImage picture = Photograph(shown, kCamera, 2, random);
  const std::vector<Board> others{{.columns = 7, .rows = 6, .square = 0.12, .first_code = 60}};
  EXPECT_THAT(FindBoards(picture, others), IsEmpty());
  EXPECT_THAT(FindBoards(picture, {}), IsEmpty());
  ColourImage mirrored = picture;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) mirrored.At(x, y) = picture.At(picture.width - 1 - x, y);
  }
  EXPECT_THAT(FindBoards(mirrored, BoardsOf(shown)), IsEmpty());
}

TEST(FindBoards, FindsNothingInNoiseOrInPicturesOfNoSize) {
  RandomStream random({}, "noise");
  const std::vector<Board> boards{{}};
  for (const auto& [width, height] : {std::pair{0, 0}, {1, 1}, {13, 5}, {200, 150}}) {
    ColourImage noise(width, height);
    for (Rgb8& pixel : noise.pixels) {
      const auto grey = static_cast<std::uint8_t>(random.IndexBelow(256));
      pixel = {grey, grey, grey};
    }
    EXPECT_THAT(FindBoards(noise, boards), IsEmpty());
  }
}

}  // namespace
}  // namespace etude
