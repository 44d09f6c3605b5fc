#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/cameras/rig_file.h"
#include "engine/keypoints/keypoint_noise.h"
#include "engine/keypoints/place_rig.h"
#include "io/files/json.h"
#include "tools/listener.h"

namespace etude {

/// The inputs, outputs and settings of `CaptureFilms`. A file name may be "" if the member's comment says so.
struct CaptureFilmsOptions {
  std::vector<std::string> films;
  std::string rig;                   ///< a calibration: a file or folder that ReadRigFile or ReadRigPair can read
  PlacementOptions place;                ///< the rig's unit, up axis and floor
  std::string keypoints;             ///< a folder with an entry for each film
  std::string marks;                 ///< a folder of annotation pictures with an entry for each film
  bool silhouettes = false;          ///< use the person's silhouettes, alone or together with keypoints
  std::string rooms;                 ///< for silhouettes: a folder with a picture of each film's empty room, "" = none
  bool accepts_doubtful = false;     ///< for silhouettes: write the motion even if `CapturedFilms::doubt` is not empty
  /// For silhouettes: a folder with masks of each film, "" = the masks are computed from the films.
  std::string masks;
  std::optional<int> mask_id;        ///< the value of the person's pixels; absent = all but the background's value
  double stature_m = 0;              ///< for silhouettes: the person's height, metres; 0 = estimated
  std::string output;                ///< in a format of FormatOfName, chosen by the extension
  std::string points;                ///< a TRC of the triangulated keypoints, "" = none
  std::string report;                ///< an HTML page with all findings, "" = none
  std::string film;                  ///< an MP4 of the skeleton over the films, "" = none
  std::string reference;             ///< a TRC with which the triangulated keypoints are compared, "" = none
  std::string distances;             ///< a file for the distances from `reference`, "" = none
  std::string layout;                ///< a name of KeypointLayouts(), "" = chosen by the number of keypoints
  std::string fit = "none";          ///< how the film's pictures differ from the rig's: none, letterbox, stretch, crop
  std::vector<std::string> cameras;  ///< the rig's camera for each film; empty = matched by the films' names
  int person = 1;
  std::string poses = "frames";  ///< for keypoints: "frames" fits each frame alone, "bundle" fits all frames at once
  double smooth_hz = 0;
  double max_gap_s = 0.5;
  /// Outlier limit, pixels; 0 = computed from the residuals, at most 3 % of the picture's longer side.
  double outlier_px = 0;
  double sync_s = 0;         ///< maximum difference of the films' clocks, seconds; 0 = the clocks agree
  std::string command_line;  ///< the command as typed, which `report` shows
  std::string version;       ///< version of the program, which `report` shows
  Listener listener = {};
};

/// The outcome of a capture.
struct CapturedFilms {
  bool is_whole = false;  ///< false if the listener stopped the overlay film: the motion was written, this film was not
  /// The reason why the motion is probably wrong; "" if there is none. With a reason, nothing was written unless
  /// doubtful motions are accepted.
  std::string doubt;
  JsonPtr facts;          ///< the findings for programs (docs/schemas/facts.schema.json, "capture")
};

/// Opens the rig in the file `path`. If a rig consists of two files, `path` names one of these files or the folder.
Result<RigFile> OpenRig(const std::string& path);

/// Captures the motion of one person from films by two or more calibrated cameras, with keypoints, marks or
/// silhouettes, and writes the motion. Fails before anything is written if films, rig or options do not fit together.
/// Every error message contains the file or the option.
Result<CapturedFilms> CaptureFilms(const CaptureFilmsOptions& options);

/// Measures the random error of the person's keypoints. The unit is one pixel of the pictures for which the rig was
/// calibrated. The function first applies and reports the same corrections as `CaptureFilms`. It uses only the options
/// for films, rig, keypoints, cameras, fit, layout, person and `sync_s`. Fails in the same cases as `CaptureFilms`.
Result<KeypointNoise> MeasureFilmedNoise(const CaptureFilmsOptions& options);

}  // namespace etude
