#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/progress_bar.h"
#include "engine/keypoints/people.h"
#include "tools/capture/capture_films.h"

namespace etude {
namespace {

constexpr const char* kCaptureText =
    "\n"
    "Two or more calibrated cameras film a person at the same time. This command recovers the person's motion from "
    "the\n"
    "films. It needs one of three sources for the person's position:\n"
    "--keypoints: keypoints of a pose estimator. The folder contains, for each film, a folder of OpenPose's JSON files "
    "or a\n"
    "  COCO keypoint file.\n"
    "--marks: marks drawn by hand. The folder contains, for each film, a folder of annotation pictures.\n"
    "--silhouettes: only the films. Etude fits an adult's body to the outline of the person who moves. --rooms sets "
    "pictures\n"
    "  of the empty rooms; without --rooms, Etude estimates each room from its film. --masks sets masks of the person, "
    "made\n"
    "  by any segmenter: black and white, soft, or with a number for each person (--mask-id selects the person).\n"
    "The name of each entry in these folders begins with the film's name: cam01.mp4, cam01_json/, cam01.png.\n\n"
    "Etude removes the lens distortion and matches persons over cameras and time. Each point is triangulated from all\n"
    "cameras that agree on it, weighted by confidence. Gaps up to --longest-gap are bridged. Then Etude fits a body "
    "with\n"
    "fixed bone lengths to each frame. With --poses bundle, it fits a smooth motion to the keypoints of all films at "
    "once. A\n"
    "table shows the distances between the body's joints and the triangulated points.\n"
    "--person 2 selects the person who is seen second most. If films did not begin at the same moment, --sync 1 finds\n"
    "delays of up to one second, to fractions of a frame, from the motion of the keypoints.\n\n"
    "The rig file is written by `etude calibrate`, or is a calibration of OpenCV, Pose2Sim, Anipose, FreeMoCap, "
    "Caliscope or\n"
    "Qualisys. For EasyMocap (intri.yml, extri.yml), OpenCV stereo (intrinsics.yml, extrinsics.yml) or COLMAP "
    "(cameras.txt,\n"
    "images.txt), give the folder or the first file. Etude finds the rig's unit and up axis from the person, and "
    "reports\n"
    "both; --rig-unit, --rig-up and --floor set them. Films are matched to the rig's cameras by name (cam01.mp4 is "
    "cam_01),\n"
    "or in the order of --cameras. If a film's size differs from the rig's picture size, --fit must state how the "
    "pictures\n"
    "were changed: letterbox (scaled, bars added), stretch, crop.\n\n"
    "Etude corrects and reports these mistakes: left and right exchanged in a camera; keypoints of another person; a "
    "film\n"
    "that is late by up to half a second or has a slightly different rate; pictures that are rotated or mirrored; "
    "keypoints\n"
    "that were measured before --fit, in pictures of another size, or in pictures padded to squares; exchanged "
    "cameras;\n"
    "inverted camera poses.\n\n"
    "With --reference FILE.trc, a table shows the distances between the triangulated keypoints and the reference, for "
    "all\n"
    "cameras together and for every pair. If the reference was made from the same keypoints, these distances show\n"
    "agreement, not error. With --silhouettes, the table shows the distances of the joints, which are errors. Every "
    "pair of\n"
    "cameras is then captured separately, which takes some time.";

struct CaptureCommandOptions {
  CaptureFilmsOptions capture;
  bool overwrite = false;
  bool as_json = false;
};

Result<int> CaptureCommand(const CaptureCommandOptions& options) {
  StdoutToStderr aside(options.as_json);
  const CaptureFilmsOptions& capture = options.capture;
  for (const auto& [path, ending] : {std::pair(&capture.output, ""),
                                     {&capture.points, ".trc"},
                                     {&capture.film, ".mp4"},
                                     {&capture.report, ".html"},
                                     {&capture.distances, ".json"}}) {
    RETURN_IF_ERROR(CheckOutput(*path, options.overwrite, ending));
  }
  ASSIGN_OR_RETURN(const CapturedFilms captured, CaptureFilms(capture));
  const bool is_refused = !captured.doubt.empty() && !capture.accepts_doubtful;
  if (!captured.is_whole) return TellStopped({{capture.film}, "stopped; Etude did not write the film"});
  aside.End();
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("capture", *captured.facts));
  if (!is_refused) return kSuccess;
  Complain({{}, captured.doubt + "; Etude wrote no motion (--accept-doubtful writes it nevertheless)"});
  return kNothingWorked;
}

}  // namespace

void DefineCapture(CLI::App& app, const std::string& command_line, Action& action) {
  auto asked = std::make_shared<CaptureCommandOptions>();
  CaptureFilmsOptions* options = &asked->capture;
  options->command_line = command_line;
  options->version = ETUDE_VERSION;
  options->listener = TerminalListener();
  CLI::App* command = app.add_subcommand("capture", "Recover the motion of a person from films by several cameras");
  // Define the films and the rig.
  command
      ->add_option("films", options->films,
                   "One film per camera. If the films did not all begin at the same moment, use --sync")
      ->required();
  command
      ->add_option("--rig", options->rig,
                   "The rig file with the calibrated cameras (`etude calibrate` writes such a file)")
      ->required();
  command->add_option("--rig-unit", options->place.unit,
                      fmt::format("Unit of length of the rig: {}, a number of metres per unit, or auto (the unit in "
                                  "which the person is 0.5 to 2.2 m tall)",
                                  RigUnits()));
  command->add_option(
      "--rig-up", options->place.up,
      "Axis of the rig that points up: x, y, z, -x, -y, -z, floor (estimated from cameras and feet), or auto");
  command->add_option("--floor", options->place.floor,
                      "The height that becomes 0: keep (the rig's height 0), feet, a height in m, or auto (the feet, "
                      "if Etude found the up axis from the feet)");
  command
      ->add_option("--cameras", options->cameras,
                   "Names of the rig's cameras in the order of the films, such as left,right")
      ->delimiter(',')
      ->allow_extra_args(false);  // otherwise, the option would also take the film names that follow its value
  // Define the sources of the person's position.
  auto* keypoints = command->add_option("--keypoints", options->keypoints, "A folder with keypoints for each film");
  auto* marks = command->add_option("--marks", options->marks, "A folder with annotation pictures for each film")
                    ->excludes(keypoints);
  auto* silhouettes = command
                          ->add_flag("--silhouettes", options->silhouettes,
                                     "Fit the body to the person's outlines in the films. The cameras must not move, "
                                     "and only one person may move. With --keypoints, the keypoints determine the "
                                     "lengths of the limbs and the direction that the body faces")
                          ->excludes(marks);
  auto* masks = command
                    ->add_option("--masks", options->masks,
                                 "Take the outlines from masks of the person, made by any segmenter: a folder that "
                                 "contains, for each film, a folder of PNG files or a film of masks")
                    ->needs(silhouettes);
  command->add_option("--mask-id", options->mask_id, "If masks number several people: the pixel value of the person")
      ->needs(masks)
      ->check(CLI::Range(1, 255));
  command->add_option("--rooms", options->rooms, "A folder with a picture of the empty room for each film")
      ->needs(silhouettes)
      ->excludes(masks);
  command
      ->add_flag(
          "--accept-doubtful", options->accepts_doubtful,
          "Write the motion even if the outlines contradict it in most frames (without this option: exit code 1)")
      ->needs(silhouettes);
  command
      ->add_option("--stature", options->stature_m,
                   "The person's standing height, in m (0: estimated from the outlines)")
      ->needs(silhouettes)
      ->check(NumberWithin(0, 2.5, "stature in m"));
  command
      ->add_option("--layout", options->layout,
                   "The order of the keypoints, if the number of keypoints does not determine it")
      ->check(OneOf(KeypointLayoutNames()));
  // Define the outputs, and the reference to compare with.
  command
      ->add_option("-o,--output", options->output,
                   "The motion file to write: .bvh, .glb, .trc, .csv, .c3d, .npz or .mot")
      ->required();
  command->add_option("--points", options->points, "Also write the triangulated keypoints (.trc)");
  command->add_option("--film", options->film, "Also write the films with the skeleton drawn over them (.mp4)");
  command->add_option(
      "--report", options->report,
      "Also write an HTML page with the film, the residuals over time, the corrections and the body (.html)");
  auto* reference = command->add_option("--reference", options->reference,
                                        "Compare the triangulated keypoints with the markers in this file (.trc)");
  command
      ->add_option("--distances", options->distances,
                   "Also write the comparison with --reference into a file for `etude report --real` (.json)")
      ->needs(reference);
  // Define how films, people and time are interpreted.
  command
      ->add_option("--fit", options->fit,
                   "How the pictures were changed, if a film's size differs from the rig's picture size")
      ->check(OneOf({"none", "letterbox", "stretch", "crop"}));
  command
      ->add_option("--person", options->person,
                   "Which person to capture: 1 is the person seen most, 2 the person seen second most")
      ->check(CLI::Range(1, 64));
  command
      ->add_option("--poses", options->poses,
                   "How poses are fitted. frames: each frame separately; bundle: one smooth motion of one body to all "
                   "keypoints at once")
      ->check(OneOf({"frames", "bundle"}))
      ->excludes(silhouettes);
  command
      ->add_option("--smooth", options->smooth_hz,
                   "With --poses frames: smooth positions by a low-pass filter with this cutoff frequency, in Hz (0: "
                   "no smoothing)")
      ->check(NumberWithin(0, 1000, "frequency in Hz"));
  // Define the limits of gaps, outliers and clocks.
  command->add_option("--longest-gap", options->max_gap_s, "Longest gap that Etude bridges, in s")
      ->check(NumberWithin(0, 60, "gap in s"));
  command
      ->add_option("--outlier", options->outlier_px,
                   "Leave out a keypoint if its distance from the point that the other cameras determine is larger "
                   "than this, in px (0: eight standard deviations of the residuals, at most 3 % of the picture)")
      ->check(NumberWithin(0, 10000, "distance in px"));
  command
      ->add_option("--sync", options->sync_s,
                   "Largest delay between the films, in s; Etude finds the delay from the keypoints (0: no delay)")
      ->check(NumberWithin(0, 60, "time in s"));
  AddOverwrite(*command, asked->overwrite, "Replace existing files");
  AddJson(*command, asked->as_json);
  command->footer(kCaptureText);
  command->callback([=, &action] { action = [=] { return Finish(CaptureCommand(*asked)); }; });
}

}  // namespace etude
