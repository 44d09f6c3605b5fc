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

constexpr const char* kCaptureExamples =
    "\nTwo or more calibrated cameras film a person at the same time; this command says how the person moved. What "
    "the\n"
    "pictures show is told by keypoints of an estimator (--keypoints: a folder with, for each film, a folder of\n"
    "OpenPose's JSON or a COCO keypoint file), by marks drawn by hand (--marks: a folder of annotation\n"
    "pictures for each film), or by the films alone (--silhouettes: an adult's body is fitted to the outline of the\n"
    "person who moves; --rooms has pictures of the empty room, else it is estimated from the films). Each entry's\n"
    "name begins with its film's: cam01.mp4, cam01_json/, cam01.png.\n\n"
    "Lenses are undone; persons are matched over cameras and time; each point comes from all cameras that agree on "
    "it,\n"
    "weighed by confidence; gaps up to --longest-gap are bridged. Then a body whose bones keep their lengths is fitted "
    "to\n"
    "each frame (--poses bundle: to the keypoints of all films at once, in a smooth motion), and a table tells how "
    "near\n"
    "its joints are to the points.\n"
    "--person 2 asks for the one seen second most. Films that did not begin at the same moment are set in time by how\n"
    "their keypoints move: --sync 1 looks up to a second either way, to fractions of a frame.\n\n"
    "The rig is what `etude calibrate` wrote, or a calibration of OpenCV, Pose2Sim, Anipose, FreeMoCap, Caliscope or\n"
    "Qualisys; of EasyMocap (intri.yml, extri.yml), OpenCV stereo (intrinsics.yml, extrinsics.yml) or COLMAP "
    "(cameras.txt,\n"
    "images.txt) the folder, or the first file. Its unit and up axis are found from the person, said, and set by "
    "--rig-unit,\n"
    "--rig-up, --floor. Films are matched to its cameras by name (cam01.mp4 is cam_01), or in the order of --cameras.\n"
    "Films of other sizes than the rig's are refused until --fit says what was done to them: letterbox (scaled, bars\n"
    "added), stretch, crop.\n\n"
    "Said, and mended: left and right exchanged in a camera, somebody else's keypoints, a film that is late by up to "
    "half\n"
    "a second or runs at a slightly other rate, pictures that are turned or mirrored, keypoints of unfitted\n"
    "pictures, of another size, of squares; cameras that were exchanged, poses that lead the other way.\n\n"
    "With --reference FILE.trc a table tells how far the triangulated keypoints are from it, for all cameras and\n"
    "every pair. Made of the same keypoints, that is agreement, not error. With --silhouettes it is the joints'\n"
    "distance, and error; every pair of cameras is then captured by itself, which takes its time.\n\n"
    "Try:\n"
    "  etude capture --rig rig.yaml cam1.mp4 cam2.mp4 --keypoints json/ -o motion.bvh\n"
    "  etude capture --rig Calib.toml cam*.mp4 --keypoints openpose/ --layout body_25b --fit letterbox \\\n"
    "                -o motion.trc --points keypoints.trc --film overlay.mp4 --smooth 6 --report page.html\n"
    "  etude capture --rig rig.yaml cam1.mp4 cam2.mp4 --silhouettes --stature 1.8 -o motion.bvh --report page.html";

struct CaptureCommandOptions {
  CaptureFilmsOptions capture;
  bool overwrite = false;
  bool as_json = false;
};

Result<int> CaptureCommand(const CaptureCommandOptions& options) {
  StdoutToStderr aside(options.as_json);
  const CaptureFilmsOptions& capture = options.capture;
  for (const std::string* path :
       {&capture.output, &capture.points, &capture.film, &capture.report, &capture.distances}) {
    if (!path->empty()) RETURN_IF_ERROR(CheckOutput(*path, options.overwrite));
  }
  ASSIGN_OR_RETURN(const CapturedFilms captured, CaptureFilms(capture));
  const bool is_refused = !captured.doubt.empty() && !capture.accepts_doubtful;
  if (!captured.is_whole) return TellStopped({{capture.film}, "stopped; there is no film"});
  aside.End();
  if (options.as_json) RETURN_IF_ERROR(PrintFacts("capture", *captured.facts));
  if (!is_refused) return kSuccess;
  Complain({{}, captured.doubt + "; nothing was written (--accept-doubtful writes it all the same)"});
  return kNothingWorked;
}

}  // namespace

void DefineCapture(CLI::App& app, const std::string& command_line, Action& action) {
  auto asked = std::make_shared<CaptureCommandOptions>();
  CaptureFilmsOptions* options = &asked->capture;
  options->command_line = command_line;
  options->version = ETUDE_VERSION;
  options->listener = TerminalListener();
  CLI::App* command = app.add_subcommand("capture", "The motion of a person out of films by several cameras");
  // The films and their rig.
  command->add_option("films", options->films, "A film of each camera, all begun at the same moment (else: --sync)")
      ->required();
  command->add_option("--rig", options->rig, "The calibrated cameras")->required();
  command
      ->add_option("--rig-unit", options->place.unit,
                   fmt::format("The rig's unit of length: {}, metres in one unit, or auto (a person has 0.5 to 2.2 m)",
                               RigUnits()))
      ->capture_default_str();
  command
      ->add_option("--rig-up", options->place.up,
                   "The rig's axis that points up: x, y, z, -x, -y, -z, floor (as cameras and feet tell), or auto")
      ->capture_default_str();
  command
      ->add_option("--floor", options->place.floor,
                   "What becomes height 0: keep (the rig's), feet, a height in m, or auto (feet where they told up)")
      ->capture_default_str();
  command->add_option("--cameras", options->cameras, "The rig's cameras in the order of the films: left,right")
      ->delimiter(',')
      ->allow_extra_args(false);  // otherwise the option would take the films that follow as its values
  // The sources of the person's position.
  auto* keypoints = command->add_option("--keypoints", options->keypoints, "A folder with keypoints for each film");
  auto* marks = command->add_option("--marks", options->marks, "A folder with annotation pictures for each film")
                    ->excludes(keypoints);
  auto* silhouettes =
      command
          ->add_flag("--silhouettes", options->silhouettes,
                     "The outlines of the one person who moves before cameras that stand still: alone, or beside "
                     "--keypoints, which then tell front from back and the limbs' lengths")
          ->excludes(marks);
  command->add_option("--rooms", options->rooms, "A folder with a picture of the empty room for each film")
      ->needs(silhouettes);
  command
      ->add_flag("--accept-doubtful", options->accepts_doubtful,
                 "Write a motion, too, that the outlines contradict in most frames (else: exit code 1)")
      ->needs(silhouettes);
  command->add_option("--stature", options->stature_m, "How tall the person is, m (0: found from the outlines)")
      ->needs(silhouettes)
      ->check(NumberWithin(0, 2.5, "stature in m"))
      ->capture_default_str();
  command->add_option("--layout", options->layout, "The order of keypoints, where their count does not tell it")
      ->check(CLI::IsMember(KeypointLayoutNames()));
  // The outputs, and the reference to compare with.
  command->add_option("-o,--output", options->output, "The motion to write: .bvh, .glb, .trc or .csv")->required();
  command->add_option("--points", options->points, "Write the triangulated keypoints, too (.trc)");
  command->add_option("--film", options->film, "Write the skeleton drawn over the films, too (.mp4)");
  command->add_option("--report", options->report,
                      "Write a page of it all: film, residuals over time, mends, body (.html)");
  auto* reference = command->add_option("--reference", options->reference,
                                        "Compare the triangulated keypoints with these markers (.trc)");
  command
      ->add_option("--distances", options->distances, "Write that comparison, too, for `etude report --real` (.json)")
      ->needs(reference);
  // How films, people and time are interpreted.
  command->add_option("--fit", options->fit, "How films of another size than the rig's came of its pictures")
      ->check(CLI::IsMember({"none", "letterbox", "stretch", "crop"}))
      ->capture_default_str();
  command->add_option("--person", options->person, "Which person, the one seen most first")
      ->check(CLI::Range(1, 64))
      ->capture_default_str();
  command
      ->add_option(
          "--poses", options->poses,
          "frames: each frame by itself; bundle: one body in smooth motion that explains all keypoints at once")
      ->check(CLI::IsMember({"frames", "bundle"}))
      ->excludes(silhouettes)
      ->capture_default_str();
  command
      ->add_option("--smooth", options->smooth_hz,
                   "Smooth places below this frequency, Hz, each frame by itself (0: not at all)")
      ->check(NumberWithin(0, 1000, "frequency in Hz"))
      ->capture_default_str();
  command->add_option("--longest-gap", options->max_gap_s, "Gaps up to this are bridged, s")
      ->check(NumberWithin(0, 60, "gap in s"))
      ->capture_default_str();
  command
      ->add_option("--outlier", options->outlier_px,
                   "A keypoint further than this from where the others say is left out, px (0: eight deviations of the "
                   "residuals, at most 3 % of the picture)")
      ->check(NumberWithin(0, 10000, "distance in px"))
      ->capture_default_str();
  command
      ->add_option("--sync", options->sync_s,
                   "The films' clocks may differ by this much, s: how much is found from the keypoints (0: they agree)")
      ->check(NumberWithin(0, 60, "time in s"))
      ->capture_default_str();
  AddOverwrite(*command, asked->overwrite, "Replace files that are there");
  AddJson(*command, asked->as_json);
  command->footer(kCaptureExamples);
  command->callback([=, &action] { action = [=] { return Finish(CaptureCommand(*asked)); }; });
}

}  // namespace etude
