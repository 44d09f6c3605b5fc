#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/terminal_listener.h"
#include "engine/cameras/dlt.h"
#include "tools/calibrate/calibrate_rig.h"

namespace etude {
namespace {

struct CalibrateCommandOptions {
  CalibrateOptions calibrate;
  bool overwrite = false;
  bool as_json = false;
};

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
                {"disagreeing_pair", nullptr},
                {"lens", {{"k1", d.k1}, {"k2", d.k2}, {"p1", d.p1}, {"p2", d.p2}, {"k3", d.k3}}},
                {"place_m", {camera.p_WC.x, camera.p_WC.y, camera.p_WC.z}}};
    if (const auto& deviation = rig.deviations[i]) {
      one["focal_deviation_px"] = {deviation->fx, deviation->fy};
      one["principal_deviation_px"] = {deviation->cx, deviation->cy};
    }
    if (i < rig.disagreeing.size() && rig.disagreeing[i]) {
      const DisagreeingPair& pair = *rig.disagreeing[i];
      one["disagreeing_pair"] = {
          {"pair", pair.index + 1}, {"error_px", pair.error_px}, {"rms_without_px", pair.rms_without_px}};
    }
    cameras.push_back(std::move(one));
  }
  return cameras;
}

Result<int> CalibrateCommand(const CalibrateCommandOptions& asked) {
  const CalibrateOptions& options = asked.calibrate;
  if (!options.print.empty()) {
    RETURN_IF_ERROR(CheckOutput(options.print, asked.overwrite, ".png"));
    RETURN_IF_ERROR(PrintBoard(options));
    return kSuccess;
  }
  if (options.inputs.empty())
    return Fail({},
                "no input is named; allowed: a file of point pairs; or for each camera a folder of pictures or a film");
  if (options.output.empty()) return Fail({}, "-o RIG.yaml is missing: it names the file for the rig");
  RETURN_IF_ERROR(CheckOutput(options.output, asked.overwrite));
  RETURN_IF_ERROR(CheckOutput(options.picture, asked.overwrite, ".png"));
  StdoutToStderr aside(asked.as_json);
  ASSIGN_OR_RETURN(const Calibrated rig, CalibrateRig(options));
  aside.End();
  if (asked.as_json) {
    RETURN_IF_ERROR(PrintFacts("calibrate", {{"cameras", FactsOf(rig)}, {"output", options.output}}));
  }
  return kSuccess;
}

constexpr const char* kCalibrateText =
    "\nA rig describes the cameras of `etude capture`: focal lengths, principal points, lens distortion and poses. It "
    "can\nbe found in two ways.\n\n"
    "From point pairs: at least six points, not all in one plane (use two or three walls), measured in metres, Y up,\n"
    "and the pixels that show them. CSV with the heading camera,x,y,z,u,v (and --size), or YAML:\n"
    "  left:  {size: [1920, 1080], pairs: [[0.0, 0.0, 0.0, 812.4, 903.1], ...]}\n"
    "  right: {size: [1920, 1080], pairs: ...}\n"
    "--method refined (the default) finds focal lengths, principal point, lens and pose by least squares of\nthe "
    "reprojection error; dlt and dlt-normalised only solve for the matrix H, as paper B does.\n\n"
    "From pictures of a board: print one (--print), glue it to something flat, and measure a square. Take ten or "
    "more\npictures with every camera: tilt the board in all directions, and fill the picture's corners, too. Pictures "
    "of the same\nmoment need the same name in every folder, and some moments must show the board to two cameras at "
    "once. The\nfirst picture determines the world: lay the board on the floor for it (--world floor). A film can "
    "replace a folder.\nIf films of a moving board did not begin at the same moment, the delay of each is found, "
    "corrected and reported.\n\n"
    "The file that is written is YAML that OpenCV reads, too: "
    "cv::FileStorage(\"rig.yaml\")[\"left\"][\"camera_matrix\"].\n"
    "`etude capture` also takes calibrations of OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope, Qualisys, EasyMocap "
    "and COLMAP.";

}  // namespace

void DefineCalibrate(CLI::App& app, Action& action) {
  auto asked = std::make_shared<CalibrateCommandOptions>();
  CalibrateOptions* options = &asked->calibrate;
  options->listener = TerminalListener();
  CLI::App* command =
      app.add_subcommand("calibrate", "Calibrate the cameras of a rig from measured points or pictures of boards");
  // Define the inputs, the output, and the board.
  command->add_option("inputs", options->inputs,
                      "A file of point pairs; or for each camera a folder of pictures or a film");
  command->add_option("-o,--output", options->output, "The rig to write (YAML)");
  command->add_option(
      "--board", options->boards,
      "COLUMNSxROWSxSQUARE: the numbers of squares, and a square's side in metres; @FIRST_CODE gives a second "
      "board other codes. Or a board of OpenCV: chess:9x6x0.025, charuco:5x7x0.04 (dictionary, colours and layout "
      "are found)");
  // Define what is estimated, and in which world frame.
  command->add_option("--method", options->method, "How cameras are computed from point pairs")
      ->check(OneOf(CalibrationNames()));
  command
      ->add_option("--lens", options->lens, "Lens parameters to find: none; radial2 (k1, k2, p1, p2); radial3 (and k3)")
      ->check(OneOf({"none", "radial2", "radial3"}));
  command->add_flag(
      "--skew", options->skew,
      "Also find the angle between the picture's axes (as paper B does; that of today's sensors is 90 degrees)");
  command->add_option("--size", options->size, "Size of the pictures, for point pairs as CSV: 1920x1080");
  command->add_option("--world", options->world, "Where the board is in the first picture: on the floor or on a wall")
      ->check(OneOf({"floor", "wall"}));
  command
      ->add_option("--every", options->every,
                   "Use every n-th frame of a film (0: every 30th; for a board of OpenCV's, at most 200 frames in all)")
      ->check(CLI::Range(0, 100000));
  command
      ->add_option("--sync", options->sync_s,
                   "Largest delay of a film that is searched for, s; the delay is found from the board (0: twice the "
                   "time between the pictures that are used)")
      ->check(NumberWithin(0, 60, "time in s"));
  // Define further outputs and comparisons.
  command->add_option("--picture", options->picture,
                      "Also draw the corners that were found, and their residuals (.png)");
  command->add_option("--beside", options->beside,
                      "Another calibration of these cameras, for a comparison of focal lengths, distances and "
                      "residuals; or opencv, for OpenCV's calibrateCamera on each camera alone");
  CLI::Option* print =
      command->add_option("--print", options->print, "Only write the board as a picture (.png) for printing");
  AddOverwrite(*command, asked->overwrite);
  AddJson(*command, asked->as_json)->excludes(print);
  command->footer(kCalibrateText);
  command->callback([=, &action] { action = [=] { return Finish(CalibrateCommand(*asked)); }; });
}

}  // namespace etude
