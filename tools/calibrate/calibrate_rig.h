#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/boards/board.h"
#include "engine/cameras/pose2sim_file.h"
#include "engine/cameras/refine.h"
#include "tools/listener.h"

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
  double sync_s = 0;            ///< films of boards may be late by this; 0: by two looks
  std::string picture;          ///< a PNG: what was found where, "" = none
  std::string beside;           ///< another calibration of these cameras to compare with, or "opencv"; "" = none
  std::string print;            ///< a PNG: the board itself, to be printed
  Listener listener = {};
};

/// A rig with what is told about it at the terminal.
struct Calibrated {
  std::vector<NamedCamera> cameras;
  std::vector<double> rms_px;
  std::vector<std::size_t> points;
  std::vector<std::optional<IntrinsicsDeviation>> deviations;
};

/// Reads "COLUMNSxROWSxSQUARE[@FIRST_CODE]".
Result<Board> ReadCodedBoard(const std::string& text);
RefineOptions RefineOptionsOf(const CalibrateOptions& options);

/// Finds boards in folders of pictures or films, sets films in step, and calibrates; says what it finds.
Result<Calibrated> CalibrateFromPictures(const CalibrateOptions& options);

/// Finds the cameras of a rig from point pairs or pictures of boards, writes the rig and what else was asked for, and tells
/// what it finds. Every complaint names the file or the option.
Result<Calibrated> CalibrateRig(const CalibrateOptions& options);

/// Draws the first of `boards` to be printed, at 16 pixels a module, and writes it to `print`.
Result<void> PrintBoard(const CalibrateOptions& options);

}  // namespace etude
