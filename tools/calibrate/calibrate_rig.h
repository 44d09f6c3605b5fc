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
  /// Either one file of point pairs; or, for each camera, one folder of pictures or one film.
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> boards = {"5x7x0.034"};  ///< board: COLUMNSxROWSxSQUARE[@FIRST_CODE]
  std::string method = "refined";                 ///< for point pairs: a name of CalibrationNames()
  std::string lens = "radial2";                   ///< lens model: none, radial2 or radial3
  bool skew = false;
  std::string size;             ///< size of the pictures, "1920x1080", if the point pairs are CSV
  std::string world = "floor";  ///< "floor" or "wall": the plane in which the first board lies
  /// Every n-th frame of a film is searched; 0 = every 30th, or for OpenCV's boards about 200 frames.
  int every = 0;
  double sync_s = 0;            ///< maximum delay between films of boards; 0 = twice the time between searched frames
  std::string picture;          ///< a PNG to write with the found corners and their errors, "" = none
  std::string beside;           ///< another calibration of these cameras for comparison, or "opencv"; "" = none
  std::string print;            ///< a PNG to write: the board itself, to be printed
  Listener listener = {};
};

/// A point pair with a wrong pixel or place, judged by the calibration from all other pairs.
struct DisagreeingPair {
  std::size_t index = 0;  ///< index among the pairs of the pair's camera, from 0
  PointPair pair;
  double error_px = 0;        ///< distance between the pair's pixel and the projection of its point by that calibration
  double rms_without_px = 0;  ///< reprojection error of all other pairs in that calibration
};

/// A rig, and the numbers that are printed about the rig, with one entry for each camera.
struct Calibrated {
  std::vector<NamedCamera> cameras;
  std::vector<double> rms_px;
  std::vector<std::size_t> points;
  std::vector<std::optional<IntrinsicsDeviation>> deviations;
  std::vector<std::optional<DisagreeingPair>> disagreeing = {};  ///< for method "refined" of point pairs; else empty
};

/// Parses "COLUMNSxROWSxSQUARE[@FIRST_CODE]". Fails, naming the option --board, on any other text and on codes beyond
/// the last existing code.
Result<Board> ReadCodedBoard(const std::string& text);
RefineOptions RefineOptionsOf(const CalibrateOptions& options);

/// Finds boards in folders of pictures or in films, synchronises the films, calibrates the rig, and reports the
/// findings.
Result<Calibrated> CalibrateFromPictures(const CalibrateOptions& options);

/// Calibrates a rig from point pairs or from pictures of boards, writes the rig and the optional outputs, and reports
/// the findings. Every error message names the file or the option.
Result<Calibrated> CalibrateRig(const CalibrateOptions& options);

/// Writes the first of `boards` to `print`, as a PNG of 16 pixels per module, with the resolution that prints the board
/// at its size. Reports the paper size on which the board fits.
Result<void> PrintBoard(const CalibrateOptions& options);

}  // namespace etude
