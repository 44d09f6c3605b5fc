#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/cameras/dlt.h"
#include "engine/cameras/opencv_file.h"
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
    const std::vector<double> matrix = ParametersOf(camera).camera_matrix;  // as in the rig's file
    Json one = {{"camera", rig.cameras[i].name},
                {"points", rig.points[i]},
                {"rms_px", rig.rms_px[i]},
                {"focal_px", {in.fx, in.fy}},
                {"principal_px", {matrix[2], matrix[5]}},
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
    return Fail(
        {},
        "the input is missing; allowed: a file of point pairs; or, for each camera, a folder of pictures or a film");
  if (options.output.empty()) return Fail({}, "the option -o RIG.yaml is missing; it sets the file that Etude writes");
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
    "\n"
    "A rig describes the cameras of `etude capture`: focal lengths, principal points, lens distortion and poses. There "
    "are\n"
    "two ways to calibrate a rig.\n\n"
    "From point pairs: measure at least six points in metres, Y up, and the pixels that show these points. The points "
    "must\n"
    "not all be in one plane; use two or three walls. The file is a CSV with the heading camera,x,y,z,u,v (add "
    "--size), or\n"
    "YAML:\n"
    "  left:  {size: [1920, 1080], pairs: [[0.0, 0.0, 0.0, 812.4, 903.1], ...]}\n"
    "  right: {size: [1920, 1080], pairs: ...}\n"
    "--method refined (the default) finds focal lengths, principal point, lens and pose by least squares of\n"
    "the reprojection error. The methods dlt and dlt-normalised only solve for the matrix H, as paper B does.\n\n"
    "From pictures of a board: print a board (--print), glue it to something flat, and measure the side of a square. "
    "Take\n"
    "ten or more pictures with every camera. Tilt the board in all directions, and place it also in the picture's "
    "corners.\n"
    "Pictures of the same moment need the same name in every folder. At some moments two cameras must see the board. "
    "The\n"
    "board in the first picture determines the world coordinates: put it on the floor (--world floor). A film can "
    "replace a\n"
    "folder. If films of a moving board did not begin at the same moment, Etude finds, corrects and reports the delay "
    "of\n"
    "each film.\n\n"
    "The written file is YAML. OpenCV can read it: cv::FileStorage(\"rig.yaml\")[\"left\"][\"camera_matrix\"].\n"
    "`etude capture` also reads calibrations of OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope, Qualisys, EasyMocap "
    "and\n"
    "COLMAP.";

}  // namespace

void DefineCalibrate(CLI::App& app, Action& action) {
  auto asked = std::make_shared<CalibrateCommandOptions>();
  CalibrateOptions* options = &asked->calibrate;
  options->listener = TerminalListener();
  CLI::App* command =
      app.add_subcommand("calibrate", "Calibrate the cameras of a rig from measured points or pictures of boards");
  // Define the inputs, the output, and the board.
  command->add_option("inputs", options->inputs,
                      "A file of point pairs; or, for each camera, a folder of pictures or a film");
  command->add_option("-o,--output", options->output, "The rig file to write (YAML)");
  command->add_option("--board", options->boards,
                      "The board as COLUMNSxROWSxSQUARE: the numbers of squares, and the side of a square in metres. "
                      "Append @FIRST_CODE to give a second board different codes. Or a board of OpenCV: "
                      "chess:9x6x0.025, charuco:5x7x0.04 (Etude finds its dictionary, colours and layout)");
  // Define what is estimated, and in which world frame.
  command->add_option("--method", options->method, "Method that computes cameras from point pairs")
      ->check(OneOf(CalibrationNames()));
  command
      ->add_option("--lens", options->lens,
                   "Lens parameters to estimate: none; radial2 (k1, k2, p1, p2); radial3 (k1, k2, k3, p1, p2)")
      ->check(OneOf({"none", "radial2", "radial3"}));
  command->add_flag(
      "--skew", options->skew,
      "Also estimate the angle between the picture's axes, as paper B does (90 degrees in modern sensors)");
  command->add_option("--size", options->size,
                      "If the input is point pairs as CSV: the size of the pictures, such as 1920x1080");
  command->add_option("--world", options->world, "Where the board is in the first picture: on the floor or on a wall")
      ->check(OneOf({"floor", "wall"}));
  command
      ->add_option("--every", options->every,
                   "Use every n-th frame of a film (0: every 30th; for a board of OpenCV, at most 200 frames in total)")
      ->check(CLI::Range(0, 100000));
  command
      ->add_option("--sync", options->sync_s,
                   "Largest delay of a film, in s; Etude finds the delay from the motion of the board (0: twice the "
                   "time between two used frames)")
      ->check(NumberWithin(0, 60, "time in s"));
  // Define further outputs and comparisons.
  command->add_option("--picture", options->picture, "Also draw the detected corners and their residuals (.png)");
  command->add_option("--beside", options->beside,
                      "Compare focal lengths, distances and residuals with another calibration of these cameras; or "
                      "`opencv`: compare with OpenCV's calibrateCamera for each camera separately");
  CLI::Option* print =
      command->add_option("--print", options->print, "Only write a picture of the board (.png) for printing");
  AddOverwrite(*command, asked->overwrite);
  AddJson(*command, asked->as_json)->excludes(print);
  command->footer(kCalibrateText);
  command->callback([=, &action] { action = [=] { return Finish(CalibrateCommand(*asked)); }; });
}

}  // namespace etude
