#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/base/angles.h"
#include "engine/keypoints/people.h"
#include "tools/forecast/forecast_rig.h"

namespace etude {
namespace {

constexpr const char* kForecastNotes =
    "\n"
    "This command forecasts, before you film, the errors of triangulated joints. It uses only the rig. Errors are root "
    "mean\n"
    "squares to first order: Etude propagates the errors of keypoints (--noise-px) and of cameras (--calibration) "
    "through\n"
    "the triangulation. For a body, it also propagates them through the fit of joint angles; bone lengths count as "
    "known.\n"
    "--films with --keypoints measures --noise-px in films, from how well the cameras agree on the person's joints. "
    "Set\n"
    "--dropout if the person's body often hides joints from a camera. If keypoints have the same error in all "
    "pictures, the\n"
    "true errors are larger.\n\n"
    "Columns of the tables:\n"
    "  Triangulated: the error of each joint on its own.\n"
    "  Fitted: the error of the same joint, if a body is fitted to all joints at once.\n"
    "  Limb: the error of the direction of the limb that ends in the joint, in degrees.\n"
    "\"What would help\" compares changed rigs with the present rig, at the places that the present rig sees.\n"
    "--table has one row per place. x_m, height_m, z_m: the place. cameras: the number of cameras that see the place.\n"
    "lost_share: the probability that fewer than two of these cameras give a keypoint. error_mm: the error, empty if "
    "fewer\n"
    "than two cameras see the place.\n\n"
    "The volume is a box on the floor around the point that the cameras look at (--middle, --size). Errors are "
    "computed at\n"
    "20 x 20 places at each of ten heights. `etude calibrate --json` prints the deviation of focal lengths for\n"
    "--calibration. The added camera has the lens of the first camera, and is at the best of 324 positions within "
    "--room.";

struct ForecastCommandOptions {
  ForecastOptions forecast;
  std::vector<double> calibration = {5, 0.1, 0.2};
  std::vector<double> middle;
  std::vector<double> size = {3, 2, 3}, room;
  bool overwrite = false;
  bool as_json = false;
};

Json TripleOf(const glm::dvec3& p) { return {p.x, p.y, p.z}; }

Json FactsOf(const RigForecast& forecast, const ForecastOptions& options) {
  // Write three lists: cameras, joints and changes.
  Json cameras = Json::array(), joints = Json::array(), changes = Json::array();
  for (const auto& [name, camera] : forecast.cameras) {
    cameras.push_back({{"camera", name}, {"place_m", TripleOf(camera.p_WC)}});
  }
  for (const ForecastJoint& joint : forecast.joints) {
    joints.push_back({{"joint", RoleName(joint.role)},
                      {"noise_px", OrNull(joint.noise_px)},
                      {"point_mm", joint.point_mm},
                      {"body_mm", joint.body_mm},
                      {"point_deg", joint.point_deg},
                      {"body_deg", joint.body_deg}});
  }
  for (const RigWorth& worth : forecast.worths) {
    changes.push_back({{"change", worth.change},
                       {"camera_m", worth.added_m ? TripleOf(*worth.added_m) : Json()},
                       {"seen", worth.seen},
                       {"median_mm", worth.median_mm}});
  }
  // Write the facts of the whole volume.
  return {{"rig", options.rig},
          {"cameras", std::move(cameras)},
          {"middle_m", {forecast.middle_m.x, forecast.middle_m.y}},
          {"measured", forecast.measured
                           ? Json{{"noise_px", forecast.measured->all_px}, {"points", forecast.measured->points}}
                           : Json()},
          {"places", forecast.places.size()},
          {"seen", forecast.seen},
          {"median_mm", forecast.median_mm},
          {"p95_mm", forecast.p95_mm},
          {"worst_mm", *forecast.worst.error_mm},
          {"worst_m", TripleOf(forecast.worst.place_m)},
          {"bodies", forecast.bodies},
          {"joints", std::move(joints)},
          {"changes", std::move(changes)}};
}

Result<int> ForecastCommand(ForecastCommandOptions asked) {
  ForecastOptions& options = asked.forecast;
  constexpr double kMmPerM = 1000, kPercent = 100;
  options.errors.calibration = {.place_m = asked.calibration[0] / kMmPerM,
                                .turn = Radians(asked.calibration[1]),
                                .focal = asked.calibration[2] / kPercent};
  if (!asked.middle.empty()) options.middle_m = glm::dvec2(asked.middle[0], asked.middle[1]);
  options.size_m = {asked.size[0], asked.size[1], asked.size[2]};
  if (!asked.room.empty()) options.room_m = glm::dvec3(asked.room[0], asked.room[1], asked.room[2]);
  RETURN_IF_ERROR(CheckOutput(options.picture, asked.overwrite, ".png"));
  RETURN_IF_ERROR(CheckOutput(options.table, asked.overwrite, ".csv"));
  RETURN_IF_ERROR(CheckOutput(options.report, asked.overwrite, ".html"));
  StdoutToStderr aside(asked.as_json);
  ASSIGN_OR_RETURN(const RigForecast forecast, ForecastRig(options));
  aside.End();
  if (asked.as_json) RETURN_IF_ERROR(PrintFacts("forecast", FactsOf(forecast, options)));
  return kSuccess;
}

}  // namespace

void DefineForecast(CLI::App& app, const std::string& command_line, Action& action) {
  auto asked = std::make_shared<ForecastCommandOptions>();
  ForecastOptions* options = &asked->forecast;
  options->command_line = command_line;
  options->version = ETUDE_VERSION;
  options->listener = TerminalListener();
  CLI::App* command =
      app.add_subcommand("forecast", "Forecast the errors of captures with a camera rig before you film");
  command->add_option("rig", options->rig, "The rig file with the calibrated cameras, as for `etude capture`")
      ->required();
  command->add_option("--rig-unit", options->place.unit,
                      fmt::format("Unit of length of the rig: {}, a number of metres per unit, or auto (the usual unit "
                                  "of the rig's file format)",
                                  RigUnits()));
  command->add_option("--rig-up", options->place.up, "Axis of the rig that points up: x, y, z, -x, -y, -z, or auto");
  command->add_option("--floor", options->place.floor,
                      "The height that becomes 0: a height in m, or auto (the rig's height 0)");
  // Define the volume in which people move.
  command->add_option("--size", asked->size, "Width (x), height and depth (z) of the volume, in m")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0.1, 100, "length in m"));
  command
      ->add_option("--middle", asked->middle,
                   "Middle of the volume on the floor: x,z in m (default: the point that the cameras look at)")
      ->delimiter(',')
      ->expected(2)
      ->check(NumberWithin(-1000, 1000, "place in m"));
  command
      ->add_option("--room", asked->room,
                   "Width (x), height and depth (z) of the room around --middle in which an additional camera may be, "
                   "in m (default: the smallest box that contains the cameras and the volume)")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0.1, 100, "length in m"));
  // Define the errors of keypoints (given, or measured in films) and of the calibration.
  auto* noise = command
                    ->add_option("--noise-px", options->errors.noise_px,
                                 "Standard deviation of the keypoint error along each picture axis, in px")
                    ->check(NumberWithin(0.001, 1000, "deviation in px"));
  auto* films = command->add_option(
      "--films", options->take.films,
      "Films of any recording with this rig: measure the keypoint error (--noise-px) in these films");
  auto* keypoints = command
                        ->add_option("--keypoints", options->take.keypoints,
                                     "With --films: a folder with keypoints for each film, as for `etude capture`")
                        ->excludes(noise)
                        ->needs(films);
  films->needs(keypoints);
  command
      ->add_option("--layout", options->take.layout,
                   "With --films: the order of the keypoints, if the number of keypoints does not determine it")
      ->check(OneOf(KeypointLayoutNames()))
      ->needs(keypoints);
  command
      ->add_option("--fit", options->take.fit,
                   "With --films: how the pictures were changed, if a film's size differs from the rig's picture size")
      ->check(OneOf({"none", "letterbox", "stretch", "crop"}))
      ->needs(keypoints);
  command
      ->add_option("--dropout", options->errors.dropout,
                   "Share of a camera's pictures in which a joint has no keypoint")
      ->check(NumberWithin(0, 0.9, "share"));
  command
      ->add_option(
          "--calibration", asked->calibration,
          "Standard deviations of each camera's errors: position in mm, direction in degrees, focal length in per cent")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0, 1000, "deviation"));
  // Define the outputs.
  command->add_option("--picture", options->picture,
                      "Also draw a heat map of the errors at each height, and the cameras from above (.png)");
  command->add_option("--table", options->table,
                      "Also write a table of the error at every place (.csv; the columns are explained below)");
  command->add_option("--report", options->report, "Also write an HTML page with the picture and all tables (.html)");
  AddOverwrite(*command, asked->overwrite, "Replace existing files");
  AddJson(*command, asked->as_json);
  command->footer(kForecastNotes);
  command->callback([=, &action] { action = [=] { return Finish(ForecastCommand(*asked)); }; });
}

}  // namespace etude
