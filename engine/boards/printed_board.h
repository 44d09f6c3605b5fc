#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/boards/find_boards.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// One of OpenCV's boards: a chessboard or a ChArUco board.
struct PrintedBoard {
  bool is_charuco = false;
  int columns = 0, rows = 0;  ///< squares per side: 4 to 64 for a chessboard, 3 to 64 for a ChArUco board
  double square = 0;          ///< side of a square, metres
};

/// Reads "chess:9x6x0.025" or "charuco:4x5x0.054". Returns nullopt if the text has neither prefix, and an error for
/// numbers that are not allowed.
std::optional<Result<PrintedBoard>> ReadPrintedBoard(std::string_view text);

/// Finds the corners of one of OpenCV's boards in pictures by OpenCV's `findChessboardCornersSB` and
/// `aruco::detectMarkers`. For a ChArUco board, the finder determines from the pictures: the dictionary, inverted
/// printing, the square of the first marker (OpenCV's old and new layouts differ for an even number of rows), and the
/// size of markers. A corner of a ChArUco board is found only if both adjacent markers are seen; it is refined by
/// `cornerSubPix`. A chessboard must be seen whole. Its top left square is the black one if columns + rows is odd;
/// otherwise its orientation is ambiguous by 180°.
class PrintedBoardFinder {
 public:
  virtual ~PrintedBoardFinder() = default;

  /// Returns the corners row by row, in our pixel coordinates; empty if there is no board.
  virtual std::vector<SeenCorner> Find(const ColourImage& picture) = 0;

  /// Describes what was detected about the board: "DICT_4X4, inverted, markers about 0.75 of a square".
  virtual std::string Told() const = 0;
};

/// One camera as calibrated by OpenCV's `calibrateCamera`.
struct OpenCvCalibration {
  Intrinsics intrinsics;
  Distortion distortion;
  double rms_px = 0;
};

/// The functions of the module engine/boards/opencv. The module is loaded on demand, because loading OpenCV takes time.
struct OpenCvBoards {
  std::unique_ptr<PrintedBoardFinder> (*make_finder)(const PrintedBoard& board);
  Result<OpenCvCalibration> (*calibrate)(std::span<const TargetView> views, const PictureSize& size, LensModel lens);
};

/// Returns a finder of the board's corners. Fails if the module was not built (libopencv-contrib-dev; `scripts/setup
/// --boards`).
Result<std::unique_ptr<PrintedBoardFinder>> MakePrintedBoardFinder(const PrintedBoard& board);

/// Calibrates one camera by OpenCV's `calibrateCamera`, for comparison with `CalibrateFromPlanes`, which takes the same
/// views and minimises the same sum. Fails like `MakePrintedBoardFinder`, for `LensModel::kAsInCamera`, and if OpenCV
/// fails.
Result<OpenCvCalibration> CalibrateByOpenCv(std::span<const TargetView> views, const PictureSize& size, LensModel lens);

}  // namespace etude
