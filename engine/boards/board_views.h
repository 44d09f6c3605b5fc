#pragma once

#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "engine/base/result.h"
#include "engine/boards/board.h"
#include "engine/boards/find_boards.h"
#include "engine/boards/printed_board.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// A board in one picture of a camera.
struct BoardSighting {
  TargetView view;        ///< of the target that the board is at this picture's moment
  std::size_t board = 0;  ///< which of the boards
  int look = -1;          ///< which of the film's pictures that were looked at, from 0; −1: of no film
};

/// Looks for boards in the pictures of a rig's cameras and collects what they show for `CalibrateFromPlanes`. A board
/// at one moment is a target of its own: it may be carried about between pictures, but pictures of one moment show it
/// at one place.
class BoardViews {
 public:
  explicit BoardViews(std::vector<Board> boards) : boards_(std::move(boards)) {}
  /// Looks for one board of OpenCV's instead.
  BoardViews(const PrintedBoard& board, std::unique_ptr<PrintedBoardFinder> finder)
      : boards_{{.columns = board.columns, .rows = board.rows, .square = board.square}}, printed_(std::move(finder)) {}

  /// Adds a picture of the camera of that number, counted from 0. Fails when its size is not that of the camera's
  /// pictures before it.
  /// @param moment names when it was taken: pictures of the same moment show boards at the same places
  /// @param look which of its film's pictures that are looked at, equally far apart, from 0; −1: of no film
  /// @return how many corners it shows
  Result<std::size_t> Add(std::size_t camera, const std::string& moment, const ColourImage& picture, int look = -1);

  /// Every board in every picture, in the order of `Add`.
  const std::vector<BoardSighting>& sightings() const { return sightings_; }
  std::vector<TargetView> views() const;
  /// The sizes of the cameras' pictures, by camera.
  const std::vector<PictureSize>& sizes() const { return sizes_; }
  /// Returns what was found out about a board of OpenCV's; "" of our own.
  std::string Told() const { return printed_ ? printed_->Told() : ""; }

 private:
  const std::vector<Board> boards_;
  std::unique_ptr<PrintedBoardFinder> printed_;
  std::map<std::pair<std::string, std::size_t>, std::size_t> targets_;  ///< of moment and board
  std::vector<BoardSighting> sightings_;
  std::vector<PictureSize> sizes_;
};

/// The pose of the first board in the world that the rig's cameras are given in.
enum class BoardStance {
  kOnFloor,  ///< its front up: X along its rows to the right, Z down its columns, Y up
  kOnWall,   ///< upright: X to the right, Y up its columns, Z out of its front
};

/// Expresses the cameras in a world with Y up, its origin at the top left corner of the first board's first square.
void TurnToStance(BoardStance stance, std::span<Camera> cameras);

}  // namespace etude
