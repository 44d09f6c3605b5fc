#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/terminal_listener.h"
#include "engine/base/angles.h"
#include "engine/keypoints/people.h"
#include "tools/forecast/forecast_rig.h"

namespace etude {
namespace {

constexpr const char* kForecastNotes =
    "\nBefore you film: how far triangulated joints will be from the truth, computed from the rig alone. Errors are "
    "root mean\n"
    "squares, to first order: the errors of keypoints (--noise-px) and cameras (--calibration) are propagated through "
    "the\n"
    "triangulation, and, for a body, through the fit of its joint angles (bone lengths count as known). --films with\n"
    "--keypoints measures --noise-px by how well the cameras agree on the person's joints. Enter a person who\n"
    "hides joints from a camera as --dropout. If keypoints err in the same way in all pictures, the true errors are "
    "larger.\n\n"
    "Triangulated: each joint by itself. Fitted: the same joint of a body that is fitted to all joints at once. Limb: "
    "the\n"
    "direction of the limb that ends in the joint, in degrees. \"What would help\" compares changed rigs with this "
    "one, at the\n"
    "places that this one sees. --table has a row for each place: x_m, height_m, z_m; cameras: how many have it in "
    "their\n"
    "pictures; lost_share: the probability that fewer than two of them give a keypoint; error_mm: empty if fewer "
    "than two\n"
    "cameras see the place.\n\n"
    "The volume is a box on the floor around the point that the cameras look at (--middle, --size); errors are "
    "computed at\n"
    "20 x 20 places at each of ten heights. `etude calibrate --json` prints the deviation of focal lengths. The added "
    "camera\n"
    "has the first camera's lens, and stands at the best of 324 positions within --room.";

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
                      {"noise_px", joint.noise_px ? Json(*joint.noise_px) : Json()},
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
  CLI::App* command = app.add_subcommand("forecast", "Forecast the errors of a rig of cameras before you film");
  command->add_option("rig", options->rig, "A file of the calibrated cameras, as for `etude capture`")->required();
  command->add_option(
      "--rig-unit", options->place.unit,
      fmt::format("The rig's unit of length: {}, metres in one unit, or auto (that of its format)", RigUnits()));
  command->add_option("--rig-up", options->place.up, "The rig's axis that points up: x, y, z, -x, -y, -z, or auto");
  command->add_option("--floor", options->place.floor,
                      "What becomes height 0: a height in m, or auto (the rig's own height 0)");
  // Define the volume in which people move.
  command->add_option("--size", asked->size, "Width (x), height and depth (z) of the volume, m")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0.1, 100, "length in m"));
  command
      ->add_option("--middle", asked->middle,
                   "Middle of the volume on the floor: x,z in m (default: where the cameras look)")
      ->delimiter(',')
      ->expected(2)
      ->check(NumberWithin(-1000, 1000, "place in m"));
  command
      ->add_option("--room", asked->room,
                   "Width (x), height and depth (z) of the room around --middle in which one more camera may stand, m "
                   "(default: the smallest box with the cameras and the volume)")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0.1, 100, "length in m"));
  // Define the errors of keypoints (given, or measured in films) and of the calibration.
  auto* noise =
      command->add_option("--noise-px", options->errors.noise_px, "Standard deviation of keypoints along each axis, px")
          ->check(NumberWithin(0.001, 1000, "deviation in px"));
  auto* films =
      command->add_option("--films", options->take.films,
                          "Films of any take with this rig: measure the keypoints' deviation (--noise-px) in them");
  auto* keypoints = command
                        ->add_option("--keypoints", options->take.keypoints,
                                     "With --films: a folder with keypoints for each film, as for `etude capture`")
                        ->excludes(noise)
                        ->needs(films);
  films->needs(keypoints);
  command
      ->add_option("--layout", options->take.layout,
                   "With --films: the order of the keypoints, if their number does not determine it")
      ->check(OneOf(KeypointLayoutNames()))
      ->needs(keypoints);
  command
      ->add_option("--fit", options->take.fit,
                   "With --films: how the rig's pictures were changed into films of another size")
      ->check(OneOf({"none", "letterbox", "stretch", "crop"}))
      ->needs(keypoints);
  command->add_option("--dropout", options->errors.dropout, "Share of a camera's pictures that give no keypoint")
      ->check(NumberWithin(0, 0.9, "share"));
  command
      ->add_option("--calibration", asked->calibration,
                   "Standard deviations of each camera: place in mm, direction in degrees, focal length in per cent")
      ->delimiter(',')
      ->expected(3)
      ->check(NumberWithin(0, 1000, "deviation"));
  // Define the outputs.
  command->add_option("--picture", options->picture,
                      "Also draw the errors at each height as a heat map, and the cameras from above (.png)");
  command->add_option("--table", options->table, "Also write the error at every place (.csv; its columns: below)");
  command->add_option("--report", options->report, "Also write a page with the picture and all tables (.html)");
  AddOverwrite(*command, asked->overwrite, "Replace existing files");
  AddJson(*command, asked->as_json);
  command->footer(kForecastNotes);
  command->callback([=, &action] { action = [=] { return Finish(ForecastCommand(*asked)); }; });
}

}  // namespace etude
