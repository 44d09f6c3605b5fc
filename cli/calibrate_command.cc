#include "cli/calibrate_command.h"

#include <fmt/core.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>

#include "bench/files/files.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "engine/base/angles.h"
#include "engine/base/order_statistics.h"
#include "engine/boards/board_views.h"
#include "engine/cameras/camera_parameters.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/rig_file.h"
#include "reports/films/decoder.h"
#include "sim/camera/jpeg.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

/// A rig with what is told about it at the terminal.
struct Calibrated {
  std::vector<NamedCamera> cameras;
  std::vector<double> rms_px;
  std::vector<std::size_t> points;
  std::vector<std::optional<IntrinsicsDeviation>> deviations;
};

/// "8x8x0.2" as numbers; nothing of anything else.
std::optional<std::vector<double>> NumbersByX(std::string_view text) {
  std::vector<double> numbers;
  while (true) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{}) return std::nullopt;
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    if (text.empty()) return numbers;
    if (text.front() != 'x') return std::nullopt;
    text.remove_prefix(1);
  }
}

bool IsWholeWithin(double value, double low, double high) {
  return value == std::floor(value) && value >= low && value <= high;
}

Result<Board> ReadBoard(const std::string& text) {
  const std::size_t at = text.find('@');
  const auto numbers = NumbersByX(std::string_view(text).substr(0, at));
  const auto first =
      at == std::string::npos ? std::vector<double>{0} : NumbersByX(std::string_view(text).substr(at + 1));
  const bool is_board = numbers && numbers->size() == 3 && IsWholeWithin((*numbers)[0], 3, kMostSquares) &&
                        IsWholeWithin((*numbers)[1], 3, kMostSquares) && (*numbers)[2] >= 0.001 &&
                        (*numbers)[2] <= 10 && first && first->size() == 1 &&
                        IsWholeWithin(first->front(), 0, kCodeCount);
  if (!is_board) {
    return Fail({}, "--board {}: no board; allowed: 3 to {} squares a side and their metres, as 8x8x0.2 or 8x8x0.2@32",
                text, kMostSquares);
  }
  const Board board{.columns = static_cast<int>((*numbers)[0]),
                    .rows = static_cast<int>((*numbers)[1]),
                    .square = (*numbers)[2],
                    .first_code = static_cast<int>(first->front())};
  if (board.first_code + CountCodes(board) > kCodeCount) {
    return Fail({}, "--board {}: it takes codes {} to {}; allowed: below {}", text, board.first_code,
                board.first_code + CountCodes(board) - 1, kCodeCount);
  }
  return board;
}

Result<std::vector<Board>> ReadBoards(const std::vector<std::string>& texts) {
  std::vector<Board> boards;
  for (const std::string& text : texts) {
    ASSIGN_OR_RETURN(const Board board, ReadBoard(text));
    for (const Board& other : boards) {
      if (board.first_code < other.first_code + CountCodes(other) &&
          other.first_code < board.first_code + CountCodes(board)) {
        return Fail({}, "--board {}: another board has its codes, too; allowed: @{} and more", text,
                    other.first_code + CountCodes(other));
      }
    }
    boards.push_back(board);
  }
  return boards;
}

RefineOptions RefineOptionsOf(const CalibrateOptions& options) {
  RefineOptions refine{.skew = options.skew};
  refine.lens = options.lens == "none"      ? LensModel::kPinhole
                : options.lens == "radial3" ? LensModel::kRadial3
                                            : LensModel::kRadial2;
  return refine;
}

Result<void> SetSize(const std::string& text, std::vector<CameraPairs>& cameras) {
  for (CameraPairs& camera : cameras) {
    if (camera.width > 0) continue;
    const auto size = NumbersByX(text);
    if (!size || size->size() != 2 || !IsWholeWithin((*size)[0], 1, 65536) || !IsWholeWithin((*size)[1], 1, 65536)) {
      return Fail({}, "--size '{}'; needed with point pairs as CSV: the pictures' width and height, as 1920x1080",
                  text);
    }
    camera.width = static_cast<int>((*size)[0]);
    camera.height = static_cast<int>((*size)[1]);
  }
  return {};
}

Result<Calibrated> FromPairs(const CalibrateOptions& options) {
  const std::string& file = options.inputs.front();
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(file));
  ASSIGN_OR_RETURN(auto cameras, ReadPointPairs(text, file));
  RETURN_IF_ERROR(SetSize(options.size, cameras));
  Calibrated rig;
  for (const CameraPairs& of : cameras) {
    const auto complain = [&](const Error& error) { return Fail({file}, "camera {}: {}", of.name, error.message); };
    rig.points.push_back(of.pairs.size());
    if (options.method == "refined") {
      const auto refined = RefineCamera(of.pairs, of.width, of.height, RefineOptionsOf(options));
      if (!refined) return complain(refined.error());
      rig.cameras.push_back({of.name, refined->cameras.front()});
      rig.deviations.push_back(refined->deviations.front());
    } else {
      const auto matrix = Calibrate(of.pairs, CalibrationNamed(options.method));
      if (!matrix) return complain(matrix.error());
      const auto parameters = Decompose(*matrix);
      if (!parameters) return complain(parameters.error());
      rig.cameras.push_back({of.name, ToCamera(*parameters, of.width, of.height)});
      rig.deviations.push_back(std::nullopt);
    }
    rig.rms_px.push_back(ReprojectionRms(rig.cameras.back().camera, {}, of.pairs));
  }
  return rig;
}

/// The pictures of a folder, in the order of their names.
Result<std::vector<fs::path>> PicturesIn(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
    std::string ending = entry.path().extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
    if (ending == ".png" || ending == ".jpg" || ending == ".jpeg") files.push_back(entry.path());
  }
  if (error) return Fail({folder.string()}, "{}", error.message());
  if (files.empty()) return Fail({folder.string()}, "no picture in it; allowed: PNG and JPG");
  std::ranges::sort(files);
  return files;
}

Result<ColourImage> ReadPicture(const fs::path& path) {
  constexpr std::size_t kMostPixels = 100'000'000;
  ASSIGN_OR_RETURN(const std::string bytes, ReadWholeFile(path));
  if (bytes.starts_with("\x89PNG")) return LoadColourPng(path.string());
  auto picture = ReadJpeg(bytes, kMostPixels);
  if (!picture) return Fail({path.string()}, "{}", picture.error().message);
  return picture;
}

/// The boards that the pictures of one camera showed.
struct BoardCounts {
  std::size_t looked = 0, with_board = 0, corners = 0;
};

Result<void> AddPicture(std::size_t camera, const std::string& moment, const ColourImage& picture,
                        const std::string& file, BoardViews& views, BoardCounts& counts) {
  const auto corners = views.Add(camera, moment, picture);
  if (!corners) return Fail({file}, "{}", corners.error().message);
  ++counts.looked;
  counts.with_board += *corners > 0 ? 1 : 0;
  counts.corners += *corners;
  return {};
}

Result<BoardCounts> AddFolder(std::size_t camera, const fs::path& folder, BoardViews& views) {
  BoardCounts counts;
  ASSIGN_OR_RETURN(const auto files, PicturesIn(folder));
  for (const fs::path& file : files) {
    ASSIGN_OR_RETURN(const ColourImage picture, ReadPicture(file));
    RETURN_IF_ERROR(AddPicture(camera, file.stem().string(), picture, file.string(), views, counts));
  }
  return counts;
}

/// Every `every`-th picture of a film; a picture's number names its moment.
Result<BoardCounts> AddFilm(std::size_t camera, const fs::path& film, const CalibrateOptions& options,
                            BoardViews& views) {
  BoardCounts counts;
  ASSIGN_OR_RETURN(const FilmFacts facts, ProbeFilm(film));
  constexpr int kUsual = 30, kPictures = 100;
  const bool is_printed = ReadPrintedBoard(options.boards.front()).has_value();
  const int every = options.every > 0 ? options.every
                    : is_printed      ? std::max(1, static_cast<int>(facts.frames) / kPictures)
                                      : kUsual;
  ASSIGN_OR_RETURN(Decoder decoder, Decoder::Start(film, facts));
  ColourImage frame;
  for (int i = 0;; ++i) {
    ASSIGN_OR_RETURN(const bool is_there, decoder.Next(frame));
    if (!is_there) return counts;
    if (i % every != 0) continue;
    RETURN_IF_ERROR(AddPicture(camera, fmt::format("{:08}", i), frame, film.string(), views, counts));
  }
}

/// The board that is looked for: one of OpenCV's, or our own.
Result<BoardViews> SearchFor(const CalibrateOptions& options) {
  const auto printed = ReadPrintedBoard(options.boards.front());
  if (!printed) {
    ASSIGN_OR_RETURN(const auto boards, ReadBoards(options.boards));
    return BoardViews(boards);
  }
  ASSIGN_OR_RETURN(const PrintedBoard board, *printed);
  if (options.boards.size() > 1)
    return Fail({}, "--board: one chessboard or ChArUco board; there are {}", options.boards.size());
  if (!board.is_charuco && (board.columns + board.rows) % 2 == 0 && options.inputs.size() > 1) {
    return Fail(
        {},
        "--board {}: turned by 180° it looks the same, so two cameras cannot be joined; allowed: columns + rows "
        "odd",
        options.boards.front());
  }
  ASSIGN_OR_RETURN(auto finder, MakePrintedBoardFinder(board));
  return BoardViews(board, std::move(finder));
}

/// Residuals of each view: those three times as far off as most are of pictures that were blurred or moved.
std::vector<TargetView> WithoutBlurred(const RefinedRig& rig, std::span<const TargetView> views) {
  std::vector<double> rms;
  for (const TargetView& view : views) {
    rms.push_back(ReprojectionRms(rig.cameras[view.camera], rig.targets[view.target], view.pairs));
  }
  constexpr double kFar = 3, kLeastPx = 0.3;
  const double limit = std::max(kLeastPx, kFar * UpperMedian(rms));
  std::vector<TargetView> kept;
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (rms[i] <= limit) kept.push_back(views[i]);
  }
  return kept;
}

Result<Calibrated> FromPictures(const CalibrateOptions& options) {
  ASSIGN_OR_RETURN(BoardViews search, SearchFor(options));
  for (std::size_t camera = 0; camera < options.inputs.size(); ++camera) {
    const fs::path input = options.inputs[camera];
    ASSIGN_OR_RETURN(const BoardCounts counts, fs::is_directory(input) ? AddFolder(camera, input, search)
                                                                       : AddFilm(camera, input, options, search));
    fmt::print("{}: {} pictures, {} of them with a board, {} corners\n", options.inputs[camera], counts.looked,
               counts.with_board, counts.corners);
  }
  std::vector<TargetView> views = search.views();
  ASSIGN_OR_RETURN(auto refined, CalibrateFromPlanes(search.sizes(), views, RefineOptionsOf(options)));
  if (!search.Told().empty()) {
    fmt::print("the board: {}\n", search.Told());
    std::vector<TargetView> kept = WithoutBlurred(refined, views);
    if (kept.size() < views.size()) {
      fmt::print("{} of {} pictures of boards left out: three times as far off as most\n", views.size() - kept.size(),
                 views.size());
      views = std::move(kept);
      ASSIGN_OR_RETURN(refined, CalibrateFromPlanes(search.sizes(), views, RefineOptionsOf(options)));
    }
  }
  TurnToStance(options.world == "floor" ? BoardStance::kOnFloor : BoardStance::kOnWall, refined.cameras);
  Calibrated rig;
  rig.rms_px = refined.camera_rms_px;
  rig.points.resize(refined.cameras.size());
  for (const TargetView& view : views) rig.points[view.camera] += view.pairs.size();
  for (std::size_t i = 0; i < refined.cameras.size(); ++i) {
    fs::path input = options.inputs[i];
    if (!input.has_filename()) input = input.parent_path();
    rig.cameras.push_back({input.stem().string(), refined.cameras[i]});
    rig.deviations.push_back(refined.deviations[i]);
  }
  return rig;
}

void Print(const Calibrated& rig) {
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Camera& camera = rig.cameras[i].camera;
    const Intrinsics& in = camera.intrinsics;
    const Distortion& d = camera.distortion;
    const CameraParameters p = ParametersIn(camera);
    fmt::print("\n{}: reprojection error {:.3f} px RMS over {} points\n", rig.cameras[i].name, rig.rms_px[i],
               rig.points[i]);
    const auto& s = rig.deviations[i];
    const auto with = [&](double value, double deviation) {
      return s ? fmt::format("{:.2f} ± {:.2f}", value, deviation) : fmt::format("{:.2f}", value);
    };
    fmt::print("  focal lengths    {}, {} px   principal point {}, {} px\n", with(in.fx, s ? s->fx : 0),
               with(in.fy, s ? s->fy : 0), with(in.cx, s ? s->cx : 0), with(in.cy, s ? s->cy : 0));
    if (!d.IsNone())
      fmt::print("  lens             k1 {:.5f}  k2 {:.5f}  p1 {:.6f}  p2 {:.6f}  k3 {:.5f}\n", d.k1, d.k2, d.p1, d.p2,
                 d.k3);
    fmt::print("  stands at        {:.3f}, {:.3f}, {:.3f} m\n", camera.p_WC.x, camera.p_WC.y, camera.p_WC.z);
    fmt::print("  paper B's        f {:.2f}  du {:.5f}  dv {:g}  pu {:.2f}  pv {:.2f}  theta {:.3f} deg\n",
               p.focal_length, p.delta_u, p.delta_v, p.principal_u, p.principal_v, Degrees(p.skew));
    fmt::print("                   omega {:.3f}  phi {:.3f}  kappa {:.3f} deg   t {:.4f}, {:.4f}, {:.4f} m\n",
               Degrees(p.omega), Degrees(p.phi), Degrees(p.kappa), p.t.x, p.t.y, p.t.z);
  }
}

Result<void> PrintBoard(const CalibrateOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.print, options.overwrite));
  ASSIGN_OR_RETURN(const Board board, ReadBoard(options.boards.front()));
  constexpr int kPixelsPerModule = 16;
  constexpr int kSide = kPixelsPerModule * kModules, kMargin = kSide / 2;
  ColourImage picture(board.columns * kSide + 2 * kMargin, board.rows * kSide + 2 * kMargin, Rgb8{255, 255, 255});
  for (int y = 0; y < board.rows * kSide; ++y) {
    for (int x = 0; x < board.columns * kSide; ++x) {
      const glm::dvec2 place = board.square / kSide * glm::dvec2(x + 0.5, y + 0.5);
      if (IsBlackAt(board, place)) picture.At(x + kMargin, y + kMargin) = {0, 0, 0};
    }
  }
  RETURN_IF_ERROR(WriteFileAtomically(options.print, EncodePng(picture)));
  TellWritten(options.print);
  fmt::print("{} x {} squares; print it so that one is {:g} mm, glue it flat, measure it again\n", board.columns,
             board.rows, 1000 * board.square);
  return {};
}

Result<void> Calibrate(const CalibrateOptions& options) {
  if (!options.print.empty()) return PrintBoard(options);
  if (options.inputs.empty())
    return Fail({}, "nothing to calibrate with; allowed: a file of point pairs, or folders of pictures");
  if (options.output.empty()) return Fail({}, "no -o RIG.yaml: where shall the rig be written?");
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  const std::string ending = fs::path(options.inputs.front()).extension().string();
  const bool is_pairs = options.inputs.size() == 1 && (ending == ".csv" || ending == ".yaml" || ending == ".yml");
  ASSIGN_OR_RETURN(const Calibrated rig, is_pairs ? FromPairs(options) : FromPictures(options));
  Print(rig);
  RETURN_IF_ERROR(WriteFileAtomically(options.output, WriteRig(rig.cameras)));
  fmt::print("\n");
  TellWritten(options.output);
  return {};
}

}  // namespace

int CalibrateCommand(const CalibrateOptions& options) {
  if (auto done = Calibrate(options); !done) return Complain(done.error());
  return kSuccess;
}

}  // namespace etude
