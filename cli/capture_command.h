#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"

namespace etude {

struct CaptureCommandOptions {
  std::vector<std::string> films;
  std::string rig;                   ///< a calibration that ReadRig knows
  std::string keypoints;             ///< a folder with an entry for each film
  std::string marks;                 ///< likewise, of annotation pictures
  bool silhouettes = false;          ///< neither: the films alone tell
  std::string rooms;                 ///< of silhouettes: a folder with a picture of each film's empty room, "" = none
  double stature_m = 0;              ///< of silhouettes: the person's, 0 = found
  std::string output;                ///< BVH, GLB, TRC or CSV by its ending
  std::string points;                ///< a TRC of the triangulated keypoints, "" = none
  std::string film;                  ///< an MP4 of the skeleton over the films, "" = none
  std::string reference;             ///< a TRC to compare the triangulated keypoints with, "" = none
  std::string distances;             ///< a file of these comparisons, "" = none
  std::string layout;                ///< a name of KeypointLayouts(), "" = by the count
  std::string fit = "none";          ///< letterbox, stretch, crop
  std::vector<std::string> cameras;  ///< of the rig, one for each film; empty: by the films' names
  int person = 1;
  double smooth_hz = 0;
  double longest_gap_s = 0.5;
  double outlier_px = 0;  ///< 0: 3 % of the picture's longer side
  double sync_s = 0;      ///< the films' clocks may differ by this; 0: they agree
  bool overwrite = false;
};

/// `etude capture`: the motion of a person out of films by several cameras.
int CaptureCommand(const CaptureCommandOptions& options);

/// Defines `etude capture`.
void DefineCapture(CLI::App& app, Action& action);

}  // namespace etude
