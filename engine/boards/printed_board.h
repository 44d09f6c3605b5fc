#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/result.h"
#include "engine/boards/board.h"
#include "engine/boards/find_boards.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// A board of OpenCV's: a chessboard, or a ChArUco board.
struct PrintedBoard {
  bool is_charuco = false;
  int columns = 0, rows = 0;  ///< squares a side, 4 to 64 of a chessboard, 3 to 64 of a ChArUco board
  double square = 0;          ///< metres
};

/// Reads "chess:9x6x0.025" or "charuco:4x5x0.054"; nothing of texts that begin otherwise. Fails for wrong numbers.
std::optional<Result<PrintedBoard>> ReadPrintedBoard(std::string_view text);

/// Finds the corners of one such board in pictures, by OpenCV's `findChessboardCornersSB` and `aruco::detectMarkers`.
/// Of a ChArUco board the dictionary, whether it is printed inverted, where its first marker is (both layouts of even
/// rows) and how large markers are is found in the pictures themselves. A corner counts where both markers beside it
/// are seen, and is refined by `cornerSubPix`. A chessboard must be seen whole; its top left square is the black one of
/// columns + rows odd, else 180° are left open.
class PrintedBoardFinder {
 public:
  virtual ~PrintedBoardFinder() = default;

  /// Returns the corners by rows, pixels of ours; none where there is no board.
  virtual std::vector<SeenCorner> Find(const ColourImage& picture) = 0;

  /// Says what was found out about the board: "DICT_4X4, inverted, markers about 0.75 of a square".
  virtual std::string Told() const = 0;
};

/// One camera as OpenCV's `calibrateCamera` finds it.
struct OpenCvCalibration {
  Intrinsics intrinsics;
  Distortion distortion;
  double rms_px = 0;
};

/// The functions of the module engine/boards/opencv: nobody who looks for no such board waits for OpenCV to be loaded.
struct OpenCvBoards {
  std::unique_ptr<PrintedBoardFinder> (*make_finder)(const PrintedBoard& board);
  Result<OpenCvCalibration> (*calibrate)(std::span<const TargetView> views, const PictureSize& size, LensModel lens);
};

/// Fails where the module was not built (libopencv-contrib-dev; `scripts/setup --boards`).
Result<std::unique_ptr<PrintedBoardFinder>> MakePrintedBoardFinder(const PrintedBoard& board);

/// Calibrates one camera by OpenCV from the very views that `CalibrateFromPlanes` gets, to compare with: both minimise
/// the same sum. Fails like `MakePrintedBoardFinder`, for `LensModel::kAsInCamera`, and where OpenCV fails.
Result<OpenCvCalibration> CalibrateByOpenCv(std::span<const TargetView> views, const PictureSize& size, LensModel lens);

}  // namespace etude
