#include "tools/calibrate/calibrate_rig.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <ranges>

#include "engine/base/angles.h"
#include "engine/base/text.h"
#include "engine/cameras/camera_parameters.h"
#include "engine/cameras/dlt.h"
#include "engine/cameras/opencv_file.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/rig_doubts.h"
#include "engine/cameras/rig_file.h"
#include "io/files/files.h"
#include "io/images/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// Parses numbers joined by 'x', as "8x8x0.2"; returns nullopt for any other text.
std::optional<std::vector<double>> NumbersByX(std::string_view text) {
  std::vector<double> numbers;
  for (const std::string_view word : SplitAt(text, 'x')) {
    const auto value = ParseNumber<double>(word);
    if (!value) return std::nullopt;
    numbers.push_back(*value);
  }
  return numbers;
}

bool IsWholeWithin(double value, double low, double high) {
  return value == std::floor(value) && value >= low && value <= high;
}

Result<void> SetSize(const std::string& text, std::vector<CameraPairs>& cameras) {
  for (CameraPairs& camera : cameras) {
    if (camera.width > 0) continue;
    const auto size = NumbersByX(text);
    if (!size || size->size() != 2 || !IsWholeWithin((*size)[0], 1, 65536) || !IsWholeWithin((*size)[1], 1, 65536)) {
      return Fail({}, "--size '{}': point pairs as CSV need the width and height of the pictures, such as 1920x1080",
                  text);
    }
    camera.width = static_cast<int>((*size)[0]);
    camera.height = static_cast<int>((*size)[1]);
  }
  return {};
}

/// Fails if the pixel of a point pair lies outside the camera's picture.
Result<void> CheckPixels(const CameraPairs& of, const std::string& file) {
  for (const PointPair& pair : of.pairs) {
    const glm::dvec2& p = pair.pixel;
    if (p.x >= 0 && p.y >= 0 && p.x <= of.width && p.y <= of.height) continue;
    return Fail({file},
                "camera {}: the pixel ({:g}, {:g}) is outside the picture of {}x{} pixels; check the pixel and the "
                "picture size (the centre of the first pixel is (0, 0))",
                of.name, p.x - kFromOpenCv, p.y - kFromOpenCv, of.width, of.height);
  }
  return {};
}

/// Finds a point pair that disagrees with the other pairs. Two conditions must hold. First, the calibration without
/// this pair has a significantly smaller squared error: F test at the level 0.01, with Bonferroni correction for the
/// number of pairs. Second, the calibration without this pair projects the point of this pair at least one pixel away
/// from the pixel of this pair. Only the 20 pairs with the largest residuals are tried.
std::optional<DisagreeingPair> FindDisagreeing(const CameraPairs& of, const RefinedRig& all,
                                               const RefineOptions& options) {
  constexpr std::size_t kMaxTried = 20;
  constexpr double kMinError_px = 1, kMaxChance = 0.01;
  const std::size_t count = of.pairs.size();
  const double freedom = 2.0 * static_cast<double>(count - 1) - static_cast<double>(all.parameters);
  if (freedom <= 0) return std::nullopt;
  const auto error_of = [&](const Camera& camera, std::size_t i) {
    return ReprojectionRms(camera, {}, std::span(of.pairs).subspan(i, 1));
  };
  std::vector<std::pair<double, std::size_t>> tried;
  for (std::size_t i = 0; i < count; ++i) tried.emplace_back(-error_of(all.cameras.front(), i), i);
  std::ranges::sort(tried);
  tried.resize(std::min(count, kMaxTried));
  std::optional<DisagreeingPair> worst;
  double least = kMaxChance / static_cast<double>(count);
  for (const std::size_t i : tried | std::views::values) {
    std::vector<PointPair> others = of.pairs;
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(i));
    const auto refined = RefineCamera(others, of.width, of.height, options);
    if (!refined) continue;  // the calibration needs this pair
    const double share = refined->rms_px * refined->rms_px * static_cast<double>(count - 1) /
                         (all.rms_px * all.rms_px * static_cast<double>(count));
    // Compute the tail probability of the F distribution (2 and `freedom` degrees of freedom).
    const double chance = std::pow(share, freedom / 2), error = error_of(refined->cameras.front(), i);
    if (!(chance < least) || error < kMinError_px) continue;
    least = chance;
    worst = DisagreeingPair{i, of.pairs[i], error, refined->rms_px};
  }
  return worst;
}

Result<Calibrated> FromPairs(const CalibrateOptions& options) {
  const std::string& file = options.inputs.front();
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(auto cameras, ReadPointPairs(text, file));
  RETURN_IF_ERROR(SetSize(options.size, cameras));
  Calibrated rig;
  for (const CameraPairs& of : cameras) {
    // Calibrate by refinement, with a lens; or by a linear method, without a lens.
    const auto complain = [&](const Error& error) { return Fail({file}, "camera {}: {}", of.name, error.message); };
    RETURN_IF_ERROR(CheckPixels(of, file));
    rig.points.push_back(of.pairs.size());
    rig.disagreeing.emplace_back();
    if (options.method == "refined") {
      const auto refined = RefineCamera(of.pairs, of.width, of.height, RefineOptionsOf(options));
      if (!refined) return complain(refined.error());
      rig.cameras.push_back({of.name, refined->cameras.front()});
      rig.deviations.push_back(refined->deviations.front());
      rig.disagreeing.back() = FindDisagreeing(of, *refined, RefineOptionsOf(options));
    } else {
      const auto matrix = Calibrate(of.pairs, CalibrationNamed(options.method));
      if (!matrix) return complain(matrix.error());
      const auto parameters = Decompose(*matrix);
      if (!parameters) return complain(parameters.error());
      rig.cameras.push_back({of.name, ToCamera(*parameters, of.width, of.height)});
      rig.deviations.push_back(std::nullopt);
    }
    rig.rms_px.push_back(ReprojectionRms(rig.cameras.back().camera, {}, of.pairs));
    const double distance = glm::distance(rig.cameras.back().camera.p_WC, of.pairs.front().world);
    constexpr double kFar_m = 500;
    if (distance > kFar_m) {
      options.listener.print(
          fmt::format("{}: the camera is {:.0f} m from the first point of its pairs; points must be in metres, and may "
                      "be in millimetres here\n",
                      of.name, distance));
    }
  }
  return rig;
}

std::string TextOf(const Calibrated& rig) {
  constexpr double kOfNinetyFive = 2;  // half width of the 95 % interval, in standard deviations
  std::string text;
  // Print each camera's reprojection error, intrinsics, lens and position, and the parameters that paper B reports.
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Camera& camera = rig.cameras[i].camera;
    const Intrinsics& in = camera.intrinsics;
    const Distortion& d = camera.distortion;
    const CameraParameters p = ParametersIn(camera);
    const std::vector<double> matrix = ParametersOf(camera).camera_matrix;  // as in the rig's file
    text += fmt::format("\n{}: reprojection error {:.3f} px RMS over {} points\n", rig.cameras[i].name, rig.rms_px[i],
               rig.points[i]);
    const auto& s = rig.deviations[i];
    // Where standard deviations are known, print half the width of the 95 % interval after the value.
    const auto with = [&](double value, double deviation) {
      return s ? fmt::format("{:.2f} ± {:.2f}", value, kOfNinetyFive * deviation) : fmt::format("{:.2f}", value);
    };
    text += fmt::format("  focal lengths    {}, {} px   principal point {}, {} px{}\n", with(in.fx, s ? s->fx : 0),
                        with(in.fy, s ? s->fy : 0), with(matrix[2], s ? s->cx : 0), with(matrix[5], s ? s->cy : 0),
                        s ? "   (±: 95 % interval)" : "");
    if (!d.IsNone())
      text += fmt::format("  lens             k1 {:.5f}  k2 {:.5f}  p1 {:.6f}  p2 {:.6f}  k3 {:.5f}\n", d.k1, d.k2, d.p1, d.p2,
                 d.k3);
    if (i < rig.disagreeing.size() && rig.disagreeing[i]) {
      const DisagreeingPair& pair = *rig.disagreeing[i];
      text += fmt::format(
          "  pair {} disagrees with the other pairs. A calibration without this pair projects the point ({:g}, {:g}, "
          "{:g})\n"
          "  {:.1f} px away from the pixel ({:g}, {:g}), and has a reprojection error of {:.3f} px RMS\n",
          pair.index + 1, pair.pair.world.x, pair.pair.world.y, pair.pair.world.z, pair.error_px,
          pair.pair.pixel.x - kFromOpenCv, pair.pair.pixel.y - kFromOpenCv, pair.rms_without_px);
    }
    text += fmt::format("  position         {:.3f}, {:.3f}, {:.3f} m\n", camera.p_WC.x, camera.p_WC.y, camera.p_WC.z);
    text += fmt::format("  as in paper B    f {:.2f}  du {:.5f}  dv {:g}  pu {:.2f}  pv {:.2f}  theta {:.3f} deg\n",
                        p.focal_length, p.delta_u, p.delta_v, matrix[2], matrix[5], Degrees(p.skew));
    text += fmt::format("                   omega {:.3f}  phi {:.3f}  kappa {:.3f} deg   t {:.4f}, {:.4f}, {:.4f} m\n",
               Degrees(p.omega), Degrees(p.phi), Degrees(p.kappa), p.t.x, p.t.y, p.t.z);
  }
  return text;
}

/// Names the smallest paper that holds the board within a printer's margins of 10 mm.
std::string PaperFor(const Board& board) {
  struct Paper {
    const char* name;
    double narrow_mm, wide_mm;
  };
  constexpr Paper kPapers[] = {{"fits on A4 or Letter", 210, 279},  // the width of A4 and the height of Letter
                               {"needs A3 paper", 297, 420},
                               {"needs A2 paper", 420, 594},
                               {"needs A1 paper", 594, 841},
                               {"needs A0 paper", 841, 1189}};
  const auto [narrow, wide] = std::minmax({1000 * board.columns * board.square, 1000 * board.rows * board.square});
  constexpr double kMargins = 20;
  for (const Paper& paper : kPapers) {
    if (narrow + kMargins <= paper.narrow_mm && wide + kMargins <= paper.wide_mm) return paper.name;
  }
  return "larger than A0 paper, so it needs a poster printer; --board 5x7x0.034 is smaller";
}

}  // namespace

Result<Board> ReadCodedBoard(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto numbers = NumbersByX(std::string_view(text).substr(0, at));
  const auto first =
      at == std::string::npos ? std::vector<double>{0} : NumbersByX(std::string_view(text).substr(at + 1));
  const bool is_board = numbers && numbers->size() == 3 && IsWholeWithin((*numbers)[0], 3, kMaxSquares) &&
                        IsWholeWithin((*numbers)[1], 3, kMaxSquares) && (*numbers)[2] >= 0.001 && (*numbers)[2] <= 10 &&
                        first && first->size() == 1 && IsWholeWithin(first->front(), 0, kCodeCount);
  if (!is_board) {
    return Fail({},
                "--board {}: allowed: 3 to {} squares along each side of the board, and the side of a square in "
                "metres, such as 8x8x0.2 or 8x8x0.2@32",
                text, kMaxSquares);
  }
  const Board board{.columns = static_cast<int>((*numbers)[0]),
                    .rows = static_cast<int>((*numbers)[1]),
                    .square = (*numbers)[2],
                    .first_code = static_cast<int>(first->front())};
  if (board.first_code + CountCodes(board) > kCodeCount) {
    return Fail({}, "--board {}: the board needs codes {} to {}; allowed: codes below {}", text, board.first_code,
                board.first_code + CountCodes(board) - 1, kCodeCount);
  }
  return board;
}

RefineOptions RefineOptionsOf(const CalibrateOptions& options) {
  RefineOptions refine{.skew = options.skew};
  refine.lens = options.lens == "none"      ? LensModel::kPinhole
                : options.lens == "radial3" ? LensModel::kRadial3
                                            : LensModel::kRadial2;
  return refine;
}

Result<void> PrintBoard(const CalibrateOptions& options) {
  ASSIGN_OR_RETURN(const Board board, ReadCodedBoard(options.boards.front()));
  constexpr int kPixelsPerModule = 16;
  constexpr int kSide = kPixelsPerModule * kModules, kMargin = kSide / 4;
  ColourImage picture(board.columns * kSide + 2 * kMargin, board.rows * kSide + 2 * kMargin, Rgb8{255, 255, 255});
  for (int y = 0; y < board.rows * kSide; ++y) {
    for (int x = 0; x < board.columns * kSide; ++x) {
      const glm::dvec2 place = board.square / kSide * glm::dvec2(x + 0.5, y + 0.5);
      if (IsBlackAt(board, place)) picture.At(x + kMargin, y + kMargin) = {0, 0, 0};
    }
  }
  RETURN_IF_ERROR(WriteFileAtomically(options.print, EncodePng(picture, kSide / board.square)));
  TellWritten(options.listener, options.print);
  constexpr double kMm = 1000;
  options.listener.print(
      fmt::format("{} x {} squares, {:.0f} x {:.0f} mm: {}. Print the board at 100 %, so that the side of a square is "
                  "{:g} mm. Glue the board onto something flat, then measure the side of a square\n",
                  board.columns, board.rows, kMm * board.columns * board.square, kMm * board.rows * board.square,
                  PaperFor(board), kMm * board.square));
  return {};
}

Result<Calibrated> CalibrateRig(const CalibrateOptions& options) {
  const std::string ending = fs::path(options.inputs.front()).extension().string();
  const bool is_pairs = options.inputs.size() == 1 && (ending == ".csv" || ending == ".yaml" || ending == ".yml");
  if (is_pairs && !(options.picture + options.beside).empty())
    return Fail({}, "--picture and --beside need pictures of boards; {} contains point pairs", options.inputs.front());
  ASSIGN_OR_RETURN(Calibrated rig, is_pairs ? FromPairs(options) : CalibrateFromPictures(options));
  options.listener.print(TextOf(rig));
  for (const std::string& doubt : RigDoubts(rig.cameras)) options.listener.print("doubtful: " + doubt + "\n");
  RETURN_IF_ERROR(WriteFileAtomically(options.output, WriteRig(rig.cameras)));
  options.listener.print("\n");
  TellWritten(options.listener, options.output);
  return rig;
}

}  // namespace etude
