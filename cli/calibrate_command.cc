#include "cli/calibrate_command.h"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "bench/files/files.h"
#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "engine/base/angles.h"
#include "engine/cameras/camera_parameters.h"
#include "engine/cameras/dlt.h"
#include "engine/cameras/pairs_file.h"
#include "engine/cameras/rig_file.h"
#include "sim/sensors/image_files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

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

}  // namespace

Result<Board> ReadCodedBoard(const std::string& text) {
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

RefineOptions RefineOptionsOf(const CalibrateOptions& options) {
  RefineOptions refine{.skew = options.skew};
  refine.lens = options.lens == "none"      ? LensModel::kPinhole
                : options.lens == "radial3" ? LensModel::kRadial3
                                            : LensModel::kRadial2;
  return refine;
}

namespace {

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

Json FactsOf(const Calibrated& rig) {
  Json cameras = Json::array();
  for (std::size_t i = 0; i < rig.cameras.size(); ++i) {
    const Camera& camera = rig.cameras[i].camera;
    const Intrinsics& in = camera.intrinsics;
    const Distortion& d = camera.distortion;
    Json one = {{"camera", rig.cameras[i].name},
                {"points", rig.points[i]},
                {"rms_px", rig.rms_px[i]},
                {"focal_px", {in.fx, in.fy}},
                {"principal_px", {in.cx, in.cy}},
                {"focal_deviation_px", nullptr},
                {"principal_deviation_px", nullptr},
                {"lens", {{"k1", d.k1}, {"k2", d.k2}, {"p1", d.p1}, {"p2", d.p2}, {"k3", d.k3}}},
                {"place_m", {camera.p_WC.x, camera.p_WC.y, camera.p_WC.z}}};
    if (const auto& deviation = rig.deviations[i]) {
      one["focal_deviation_px"] = {deviation->fx, deviation->fy};
      one["principal_deviation_px"] = {deviation->cx, deviation->cy};
    }
    cameras.push_back(std::move(one));
  }
  return cameras;
}

Result<void> PrintBoard(const CalibrateOptions& options) {
  RETURN_IF_ERROR(CheckOutput(options.print, options.overwrite));
  ASSIGN_OR_RETURN(const Board board, ReadCodedBoard(options.boards.front()));
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
  for (const std::string* path : {&options.output, &options.picture}) {
    if (!path->empty()) RETURN_IF_ERROR(CheckOutput(*path, options.overwrite));
  }
  const std::string ending = fs::path(options.inputs.front()).extension().string();
  const bool is_pairs = options.inputs.size() == 1 && (ending == ".csv" || ending == ".yaml" || ending == ".yml");
  if (is_pairs && !(options.picture + options.beside).empty())
    return Fail({}, "--picture and --beside are of boards; {} has point pairs", options.inputs.front());
  Aside aside(options.as_json);
  ASSIGN_OR_RETURN(const Calibrated rig, is_pairs ? FromPairs(options) : CalibrateFromPictures(options));
  Print(rig);
  RETURN_IF_ERROR(WriteFileAtomically(options.output, WriteRig(rig.cameras)));
  fmt::print("\n");
  TellWritten(options.output);
  aside.End();
  if (!options.as_json) return {};
  return PrintFacts("calibrate", {{"cameras", FactsOf(rig)}, {"output", options.output}});
}

}  // namespace

int CalibrateCommand(const CalibrateOptions& options) {
  if (auto done = Calibrate(options); !done) return Complain(done.error());
  return kSuccess;
}

namespace {

constexpr const char* kCalibrateExamples =
    "\nA rig is what `etude capture` needs to know of its cameras: focal lengths, principal points, lenses, and where\n"
    "they stand. Two ways lead to it.\n\n"
    "From point pairs: at least six points that fill a volume (not one wall: two or three), measured in metres, Y up,\n"
    "and the pixels that show them. CSV with the heading camera,x,y,z,u,v (and --size), or YAML:\n"
    "  left:  {size: [1920, 1080], pairs: [[0.0, 0.0, 0.0, 812.4, 903.1], ...]}\n"
    "  right: {size: [1920, 1080], pairs: ...}\n"
    "--method refined (the default) finds focal lengths, principal point, lens and pose by least squares of\n"
    "the reprojection error; dlt and dlt-normalised solve for the matrix H alone, as paper B does.\n\n"
    "From pictures of a board: print one (--print), glue it to something flat, and measure a square. Take ten or more\n"
    "pictures with every camera, the board tilted this way and that and filling the picture's corners; pictures of "
    "one\n"
    "moment have one name in every folder, and some moments must show the board to two cameras at once. The first\n"
    "picture tells the world: lay the board on the floor there (--world floor). A film will do for a folder; films of "
    "a\n"
    "moving board that did not begin at the same moment are set in step, and how late each is is said.\n\n"
    "The file that is written is YAML that OpenCV reads, too: "
    "cv::FileStorage(\"rig.yaml\")[\"left\"][\"camera_matrix\"].\n"
    "`etude capture` also takes calibrations of OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope, Qualisys, EasyMocap "
    "and COLMAP.\n\n"
    "Try:\n"
    "  etude calibrate --print board.png --board 8x8x0.1                a board of 80 cm, squares of 10 cm\n"
    "  etude calibrate left/ right/ --board 8x8x0.1 -o rig.yaml         folders of PNG or JPG pictures\n"
    "  etude calibrate left.mp4 right.mp4 --board 8x8x0.1 -o rig.yaml   films that run alike\n"
    "  etude calibrate a.mp4 b.mp4 --board charuco:5x7x0.04 --sync 2 --picture found.png -o rig.yaml\n"
    "  etude calibrate a.mp4 b.mp4 --board charuco:4x5x0.054 -o rig.yaml   a board of OpenCV's, squares counted\n"
    "  etude calibrate pairs.csv --size 1920x1080 -o rig.yaml           measured points";

}  // namespace

void DefineCalibrate(CLI::App& app, Action& action) {
  auto options = std::make_shared<CalibrateOptions>();
  CLI::App* command =
      app.add_subcommand("calibrate", "The cameras of a rig, from measured points or pictures of boards");
  command->add_option("inputs", options->inputs,
                      "A file of point pairs; or for each camera a folder of pictures or a film");
  command->add_option("-o,--output", options->output, "The rig to write (YAML)");
  command
      ->add_option(
          "--board", options->boards,
          "COLUMNSxROWSxSQUARE, squares and metres, @FIRST_CODE for a second board with codes of its own; or one of "
          "OpenCV's: chess:9x6x0.025, charuco:5x7x0.04 (its dictionary, print and layout are found)")
      ->capture_default_str();
  command->add_option("--method", options->method, "Of point pairs")
      ->check(CLI::IsMember(CalibrationNames()))
      ->capture_default_str();
  command
      ->add_option("--lens", options->lens, "What is found of a lens: none; radial2 (k1, k2, p1, p2); radial3 (and k3)")
      ->check(CLI::IsMember({"none", "radial2", "radial3"}))
      ->capture_default_str();
  command->add_flag("--skew", options->skew,
                    "Find the angle between the picture's axes, too (paper B; sensors have none)");
  command->add_option("--size", options->size, "Of the pictures of point pairs as CSV: 1920x1080");
  command->add_option("--world", options->world, "How the board of the first picture stands: floor or wall")
      ->check(CLI::IsMember({"floor", "wall"}))
      ->capture_default_str();
  command
      ->add_option("--every", options->every,
                   "Look at every so many frames of a film (0: 30; for a board of OpenCV's, 200 frames or less in all)")
      ->check(CLI::Range(0, 100000))
      ->capture_default_str();
  command
      ->add_option("--sync", options->sync_s,
                   "Films of boards may be late by this much, s; how much is found from the board (0: up to two of the "
                   "pictures that are looked at)")
      ->check(NumberWithin(0, 60, "time in s"))
      ->capture_default_str();
  command->add_option("--picture", options->picture, "Draw what was found where, and how far off, too (PNG)");
  command->add_option(
      "--beside", options->beside,
      "Another calibration of these cameras: focal lengths, distances and residuals of both; opencv: its "
      "calibrateCamera, each camera alone");
  CLI::Option* print = command->add_option("--print", options->print,
                                           "Write the board as a picture (PNG) to be printed, and nothing else");
  AddOverwrite(*command, options->overwrite);
  AddJson(*command, options->as_json)->excludes(print);
  command->footer(kCalibrateExamples);
  command->callback([=, &action] { action = [=] { return CalibrateCommand(*options); }; });
}

}  // namespace etude
