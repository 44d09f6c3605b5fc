#pragma once

#include <string>
#include <vector>

#include "cli/arguments.h"

namespace etude {

struct CalibrateOptions {
  std::vector<std::string> inputs;  ///< a file of point pairs, or a folder of pictures or a film for each camera
  std::string output;
  std::vector<std::string> boards = {"8x8x0.2"};  ///< COLUMNSxROWSxSQUARE[@FIRST_CODE]
  std::string method = "refined";                 ///< of point pairs: a name of CalibrationNames()
  std::string lens = "radial2";                   ///< none, radial2, radial3
  bool skew = false;
  std::string size;             ///< "1920x1080", of the pictures of point pairs as CSV
  std::string world = "floor";  ///< floor or wall: how the first board stands
  int every = 0;                ///< of a film, every so many frames are looked at; 0: 30, of OpenCV's boards 100 in all
  std::string print;            ///< a PNG: the board itself, to be printed
  bool overwrite = false;
};

/// `etude calibrate`: finds the cameras of a rig from point pairs or pictures of boards, or (`print`) draws a board.
int CalibrateCommand(const CalibrateOptions& options);

/// Defines `etude calibrate`.
void DefineCalibrate(CLI::App& app, Action& action);

}  // namespace etude
