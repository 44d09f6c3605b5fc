// Calibrates cameras from rendered pictures of boards: corners are at their true pixels, and the truth lies within the
// reported ±.
#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

#include "engine/base/angles.h"
#include "engine/boards/board_views.h"
#include "tests/support/random_clip.h"

namespace etude {
namespace {

using testing::Dice;

constexpr int kWidth = 640, kHeight = 480;
constexpr double kFocal = 620;

/// A flat board: which parts are black, metres from its top left corner.
struct Sheet {
  bool is_chess = false;
  int columns = 9, rows = 6;
  double square = 0.05;

  std::optional<bool> BlackAt(const glm::dvec2& p) const {
    const glm::dvec2 size(columns * square, rows * square);
    if (p.x < -square || p.y < -square || p.x > size.x + square || p.y > size.y + square) return std::nullopt;
    if (p.x < 0 || p.y < 0 || p.x >= size.x || p.y >= size.y) return false;
    if (!is_chess) return IsBlackAt({columns, rows, square, 0}, p);
    return IsBlackSquare(static_cast<int>(p.x / square), static_cast<int>(p.y / square));
  }
};

struct View {
  glm::dmat3 R_CT{1};
  glm::dvec3 p_CT{0};  ///< the board's top left corner in the camera's frame

  glm::dvec2 PixelOf(const glm::dvec2& on) const {
    const glm::dvec3 p = R_CT * glm::dvec3(on, 0) + p_CT;
    return kFocal * glm::dvec2(p) / p.z + glm::dvec2(0.5 * kWidth, 0.5 * kHeight);
  }
};

View Thrown(const Sheet& sheet, Dice& dice) {
  View view;
  const auto turn = [&](double degrees, const glm::dvec3& axis) {
    return glm::angleAxis(Radians(degrees * dice.Signed()), axis);
  };
  view.R_CT = glm::mat3_cast(turn(35, {0, 1, 0}) * turn(35, {1, 0, 0}) * turn(25, {0, 0, 1}));
  const glm::dvec3 middle(0.5 * sheet.columns * sheet.square, 0.5 * sheet.rows * sheet.square, 0);
  view.p_CT = glm::dvec3(0.1 * dice.Signed(), 0.07 * dice.Signed(), 0.85 + 0.2 * dice.Signed()) - view.R_CT * middle;
  return view;
}

/// Renders the board: nine rays per pixel, lens blur, sensor noise.
ColourImage PhotographOf(const Sheet& sheet, const View& view, double blur_px, Dice& dice) {
  const glm::dmat3 R_TC = glm::transpose(view.R_CT);
  const glm::dvec3 eye = -(R_TC * view.p_CT);
  std::vector<double> light(kWidth * kHeight);
  for (int i = 0; i < kWidth * kHeight; ++i) {
    for (int k = 0; k < 9; ++k) {
      const glm::dvec2 pixel(i % kWidth + (k % 3 + 0.5) / 3, i / kWidth + (k / 3 + 0.5) / 3);
      const glm::dvec3 ray = R_TC * glm::dvec3((pixel - glm::dvec2(0.5 * kWidth, 0.5 * kHeight)) / kFocal, 1);
      const auto black = sheet.BlackAt(glm::dvec2(eye - eye.z / ray.z * ray));
      light[static_cast<std::size_t>(i)] += (!black ? 120 : *black ? 30 : 220) / 9.0;
    }
  }
  // Blur along rows, then along columns.
  const int reach = static_cast<int>(3 * blur_px + 1);
  for (const int step : {1, kWidth}) {
    std::vector<double> blurred(light.size());
    for (int i = 0; i < kWidth * kHeight; ++i) {
      double sum = 0, all = 0;
      for (int k = -reach; k <= reach; ++k) {
        const int at = step == 1 ? i % kWidth + k : i / kWidth + k;
        if (at < 0 || at >= (step == 1 ? kWidth : kHeight)) continue;
        const double weight = std::exp(-0.5 * k * k / (blur_px * blur_px));
        sum += weight * light[static_cast<std::size_t>(i + k * step)];
        all += weight;
      }
      blurred[static_cast<std::size_t>(i)] = sum / all;
    }
    light = std::move(blurred);
  }
  ColourImage picture(kWidth, kHeight);
  for (std::size_t i = 0; i < light.size(); ++i) {
    const double noise = 1.5 * (dice.Signed() + dice.Signed() + dice.Signed());
    const auto grey = static_cast<std::uint8_t>(std::clamp(light[i] + noise + 0.5, 0.0, 255.0));
    picture.pixels[i] = {grey, grey, grey};
  }
  return picture;
}

/// Finds a sheet's board; nullopt without the module of OpenCV's detectors.
std::optional<BoardViews> SearchFor(const Sheet& sheet) {
  if (!sheet.is_chess) return BoardViews({Board{sheet.columns, sheet.rows, sheet.square, 0}});
  const PrintedBoard board{.columns = sheet.columns, .rows = sheet.rows, .square = sheet.square};
  auto finder = MakePrintedBoardFinder(board);
  if (!finder) return std::nullopt;
  return BoardViews(board, *std::move(finder));
}

struct Measured {
  double corner_px = 0;  ///< RMS distance of the corners from the truth
  int calibrations = 0, covered = 0;
  double bias_px = 0, scatter_px = 0, told_px = 0;  ///< focal length: mean error, RMS error, mean of the reported ±
};

/// Calibrates a camera from `pictures` pictures, `calibrations` times.
std::optional<Measured> Measure(const Sheet& sheet, double blur_px, int calibrations, std::uint64_t seed,
                                int pictures = 10) {
  Measured measured;
  double squares = 0, off_squares = 0;
  std::size_t corners = 0;
  for (int i = 0; i < calibrations; ++i) {
    auto search = SearchFor(sheet);
    if (!search) return std::nullopt;
    Dice dice(seed + static_cast<std::uint64_t>(i));
    std::vector<View> views;
    for (int k = 0; k < pictures; ++k) {
      views.push_back(Thrown(sheet, dice));
      const std::size_t before = search->views().size();
      EXPECT_TRUE(search->Add(0, std::to_string(k), PhotographOf(sheet, views.back(), blur_px, dice)));
      if (search->views().size() == before) continue;
      const TargetView seen = search->views().back();
      for (const PointPair& pair : seen.pairs) {
        const glm::dvec2 off = pair.pixel - views.back().PixelOf(glm::dvec2(pair.world));
        squares += glm::dot(off, off);
        ++corners;
      }
    }
    const auto rig = CalibrateFromPlanes(search->sizes(), search->views(), {.lens = LensModel::kPinhole});
    EXPECT_TRUE(rig);
    if (!rig) continue;
    constexpr double kNinetyFive = 2;  // as in `etude calibrate`'s output
    const double off = rig->cameras[0].intrinsics.fx - kFocal, told = kNinetyFive * rig->deviations[0].fx;
    ++measured.calibrations;
    measured.covered += std::abs(off) <= told;
    measured.bias_px += off;
    measured.told_px += told;
    off_squares += off * off;
  }
  measured.corner_px = std::sqrt(squares / static_cast<double>(corners));
  measured.bias_px /= measured.calibrations;
  measured.told_px /= measured.calibrations;
  measured.scatter_px = std::sqrt(off_squares / measured.calibrations);
  return measured;
}

const Sheet kChess{.is_chess = true};
const Sheet kOwn{.is_chess = false, .columns = 7, .rows = 5, .square = 0.06};

TEST(RenderedCalibration, CornersAreWhereTheyWere) {
  for (const auto& [sheet, blur_px, limit_px] :
       {std::tuple(kChess, 0.7, 0.05), {kChess, 2.0, 0.06}, {kOwn, 0.7, 0.08}}) {
    const auto measured = Measure(sheet, blur_px, 1, 5, 3);
    if (!measured) continue;  // no OpenCV
    EXPECT_LT(measured->corner_px, limit_px) << blur_px;
  }
}

TEST(RenderedCalibration, HEAVY_TheTruthIsWithinWhatIsTold) {
  for (const Sheet& sheet : {kChess, kOwn}) {
    for (const double blur_px : {0.7, 2.0}) {
      const auto measured = Measure(sheet, blur_px, 60, 100);
      if (!measured) continue;
      fmt::print(
          "{}, blur {} px: corners {:.3f} px RMS; f {:+.2f} px in the mean, {:.2f} RMS, ± {:.2f} told, {} of {} "
          "within\n",
          sheet.is_chess ? "chessboard" : "coded board", blur_px, measured->corner_px, measured->bias_px,
          measured->scatter_px, measured->told_px, measured->covered, measured->calibrations);
      EXPECT_GE(measured->covered, 54) << sheet.is_chess << blur_px;
      EXPECT_EQ(measured->calibrations, 60);
    }
  }
}

}  // namespace
}  // namespace etude
