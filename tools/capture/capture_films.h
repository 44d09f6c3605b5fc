#pragma once

#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/keypoints/place_rig.h"
#include "io/files/json.h"
#include "tools/listener.h"

namespace etude {

/// What `CaptureFilms` works on and writes. Names of files may be empty where it says so.
struct CaptureFilmsOptions {
  std::vector<std::string> films;
  std::string rig;                   ///< a calibration: a file or a folder that ReadRigFile or ReadRigPair knows
  PlacementOptions place;                ///< its unit, up axis and floor
  std::string keypoints;             ///< a folder with an entry for each film
  std::string marks;                 ///< likewise, of annotation pictures
  bool silhouettes = false;          ///< the films' outlines tell, alone or beside keypoints
  std::string rooms;                 ///< of silhouettes: a folder with a picture of each film's empty room, "" = none
  double stature_m = 0;              ///< of silhouettes: the person's, 0 = found
  std::string output;                ///< BVH, GLB, TRC or CSV by its ending
  std::string points;                ///< a TRC of the triangulated keypoints, "" = none
  std::string report;                ///< an HTML page of all that was found, "" = none
  std::string film;                  ///< an MP4 of the skeleton over the films, "" = none
  std::string reference;             ///< a TRC to compare the triangulated keypoints with, "" = none
  std::string distances;             ///< a file of these comparisons, "" = none
  std::string layout;                ///< a name of KeypointLayouts(), "" = by the count
  std::string fit = "none";          ///< letterbox, stretch, crop
  std::vector<std::string> cameras;  ///< of the rig, one for each film; empty: by the films' names
  int person = 1;
  std::string poses = "frames";  ///< of keypoints: each by itself, or "bundle": all at once
  double smooth_hz = 0;
  double max_gap_s = 0.5;
  double outlier_px = 0;  ///< 0: by the residuals, at most 3 % of the picture's longer side
  double sync_s = 0;      ///< the films' clocks may differ by this; 0: they agree
  std::string command_line;  ///< what was typed, for the page
  std::string version;       ///< the program's, for the page
  Listener listener = {};
};

/// The outcome of a capture.
struct CapturedFilms {
  bool is_whole = false;  ///< false: a film was stopped; the motion is written, the film is not
  JsonPtr facts;          ///< what was found, for programs (docs/schemas/facts.schema.json, "capture")
};

/// Captures the motion of one person out of films by two or more calibrated cameras, from keypoints, marks or outlines,
/// and writes it. Fails, before anything is written, on films, rigs or options that do not fit together; every
/// complaint names the file or the option.
Result<CapturedFilms> CaptureFilms(const CaptureFilmsOptions& options);

}  // namespace etude
