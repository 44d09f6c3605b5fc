#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "cli/terminal_listener.h"
#include "engine/keypoints/people.h"
#include "tools/capture/capture_films.h"

namespace etude {
namespace {

constexpr const char* kCaptureText =
    "\nTwo or more calibrated cameras film a person at the same time; this command recovers the person's motion. "
    "The\nperson in the pictures is given by keypoints of an estimator (--keypoints: a folder with, for each film, a "
    "folder of\n"
    "OpenPose's JSON or a COCO keypoint file), by marks drawn by hand (--marks: a folder of annotation\n"
    "pictures for each film), or by the films alone (--silhouettes: an adult's body is fitted to the outline of the\n"
    "person who moves; --rooms names pictures of the empty room; without it, the room is estimated from the films;\n"
    "--masks names the person's masks by any segmenter: black and white, soft, or numbers, of which --mask-id is the "
    "person). Each entry's\n"
    "name begins with its film's: cam01.mp4, cam01_json/, cam01.png.\n\n"
    "The distortion of lenses is removed. Persons are matched over cameras and time; each point is computed from "
    "all\ncameras that agree on it, weighted by confidence; gaps up to --longest-gap are bridged. Then a body whose "
    "bones keep\ntheir lengths is fitted to each frame (--poses bundle: to the keypoints of all films at once, in a "
    "smooth motion),\nand a table shows how near its joints are to the points.\n"
    "--person 2 selects the person who is seen second most. Films that did not begin at the same moment are "
    "synchronised\nby the motion of their keypoints: --sync 1 searches up to one second in both directions, to "
    "fractions of a frame.\n\n"
    "The rig is what `etude calibrate` wrote, or a calibration of OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope or\n"
    "Qualisys; for EasyMocap (intri.yml, extri.yml), OpenCV stereo (intrinsics.yml, extrinsics.yml) or COLMAP "
    "(cameras.txt,\n"
    "images.txt), give the folder or the first file. Its unit and up axis are found from the person and reported; "
    "--rig-unit,\n--rig-up and --floor set them. Films are matched to its cameras by name (cam01.mp4 is cam_01), or in "
    "the order of --cameras.\n"
    "Films whose size differs from the rig's need --fit, which states how they were changed: letterbox (scaled, "
    "bars\nadded), stretch, crop.\n\n"
    "These mistakes are corrected and reported: left and right exchanged in a camera; keypoints of another person; a "
    "film\nthat is late by up to half a second or has a slightly different rate; pictures that are rotated or "
    "mirrored; keypoints\nthat were measured before --fit, in pictures of another size, or in pictures padded to "
    "squares; exchanged cameras;\ninverted camera poses.\n\n"
    "With --reference FILE.trc a table shows the distance of the triangulated keypoints from it, for all cameras "
    "and\nevery pair. If the reference was made from the same keypoints, this is agreement, not error. With "
    "--silhouettes it is\nthe distance of the joints, which is error; every pair of cameras is then captured "
    "separately, which takes some time.";

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
  if (!captured.is_whole) return TellStopped({{capture.film}, "stopped; the film was not written"});
  aside.End();
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("capture", *captured.facts));
  if (!is_refused) return kSuccess;
  Complain({{}, captured.doubt + "; nothing was written (--accept-doubtful writes the motion nevertheless)"});
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
      ->add_option("films", options->films, "One film per camera, all begun at the same moment (otherwise use --sync)")
      ->required();
  command->add_option("--rig", options->rig, "A file of the calibrated cameras (etude calibrate writes one)")
      ->required();
  command->add_option("--rig-unit", options->place.unit,
                      fmt::format("The rig's unit of length: {}, metres in one unit, or auto (the unit in which the "
                                  "person is 0.5 to 2.2 m tall)",
                                  RigUnits()));
  command->add_option(
      "--rig-up", options->place.up,
      "The rig's axis that points up: x, y, z, -x, -y, -z, floor (found from cameras and feet), or auto");
  command->add_option("--floor", options->place.floor,
                      "What becomes height 0: keep (the rig's), feet, a height in m, or auto (the feet, if the up axis "
                      "was found from them)");
  command->add_option("--cameras", options->cameras, "The rig's cameras in the order of the films: left,right")
      ->delimiter(',')
      ->allow_extra_args(false);  // otherwise, the option would also take the film names that follow its value
  // Define the sources of the person's position.
  auto* keypoints = command->add_option("--keypoints", options->keypoints, "A folder with keypoints for each film");
  auto* marks = command->add_option("--marks", options->marks, "A folder with annotation pictures for each film")
                    ->excludes(keypoints);
  auto* silhouettes =
      command
          ->add_flag("--silhouettes", options->silhouettes,
                     "Fit the body to the person's outlines in the films; one person moves, and the cameras do not. If "
                     "--keypoints is given, too, the keypoints determine the limbs' lengths and the body's front")
          ->excludes(marks);
  auto* masks =
      command
          ->add_option("--masks", options->masks,
                       "A folder with masks of the person for each film, by any segmenter: a folder of PNG files "
                       "or a film of masks. The outlines are then taken from the masks")
          ->needs(silhouettes);
  command
      ->add_option("--mask-id", options->mask_id,
                   "The value of the person's pixels in masks that number several people")
      ->needs(masks)
      ->check(CLI::Range(1, 255));
  command->add_option("--rooms", options->rooms, "A folder with a picture of the empty room for each film")
      ->needs(silhouettes)
      ->excludes(masks);
  command
      ->add_flag("--accept-doubtful", options->accepts_doubtful,
                 "Write a motion even if the outlines contradict it in most frames (otherwise: exit code 1)")
      ->needs(silhouettes);
  command->add_option("--stature", options->stature_m, "How tall the person is, m (0: found from the outlines)")
      ->needs(silhouettes)
      ->check(NumberWithin(0, 2.5, "stature in m"));
  command->add_option("--layout", options->layout, "The order of the keypoints, if their number does not determine it")
      ->check(OneOf(KeypointLayoutNames()));
  // Define the outputs, and the reference to compare with.
  command->add_option("-o,--output", options->output, "The motion to write: .bvh, .glb, .trc, .csv, .c3d, .npz or .mot")
      ->required();
  command->add_option("--points", options->points, "Also write the triangulated keypoints (.trc)");
  command->add_option("--film", options->film, "Also write the films with the skeleton drawn over them (.mp4)");
  command->add_option("--report", options->report,
                      "Also write a page with the film, the residuals over time, the corrections and the body (.html)");
  auto* reference = command->add_option("--reference", options->reference,
                                        "Compare the triangulated keypoints with these markers (.trc)");
  command
      ->add_option("--distances", options->distances, "Also write that comparison, for `etude report --real` (.json)")
      ->needs(reference);
  // Define how films, people and time are interpreted.
  command->add_option("--fit", options->fit, "How the rig's pictures were changed into films of another size")
      ->check(OneOf({"none", "letterbox", "stretch", "crop"}));
  command->add_option("--person", options->person, "Number of the person; 1 is the one seen most")
      ->check(CLI::Range(1, 64));
  command
      ->add_option(
          "--poses", options->poses,
          "frames: each frame by itself; bundle: one body in smooth motion that explains all keypoints at once")
      ->check(OneOf({"frames", "bundle"}))
      ->excludes(silhouettes);
  command
      ->add_option(
          "--smooth", options->smooth_hz,
          "Smooth positions by a low pass of this frequency, Hz, for poses fitted frame by frame (0: no smoothing)")
      ->check(NumberWithin(0, 1000, "frequency in Hz"));
  // Define the limits of gaps, outliers and clocks.
  command->add_option("--longest-gap", options->max_gap_s, "Longest gap that is bridged, s")
      ->check(NumberWithin(0, 60, "gap in s"));
  command
      ->add_option("--outlier", options->outlier_px,
                   "Largest distance of a keypoint from the point that the other cameras determine, px; more distant "
                   "ones are left out (0: eight standard deviations of the residuals, at most 3 % of the picture)")
      ->check(NumberWithin(0, 10000, "distance in px"));
  command
      ->add_option("--sync", options->sync_s,
                   "Largest difference of the films' clocks, s; the difference is found from the keypoints (0: the "
                   "clocks agree)")
      ->check(NumberWithin(0, 60, "time in s"));
  AddOverwrite(*command, asked->overwrite, "Replace existing files");
  AddJson(*command, asked->as_json);
  command->footer(kCaptureText);
  command->callback([=, &action] { action = [=] { return Finish(CaptureCommand(*asked)); }; });
}

}  // namespace etude
