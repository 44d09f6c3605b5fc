#pragma once

#include <map>
#include <memory>
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

/// One board in one picture of a camera.
struct BoardSighting {
  TargetView view;  ///< view of the board; the view's target is the board at the time of this picture
  std::size_t board = 0;
  int look = -1;  ///< index of the picture among the examined pictures of a film; −1 if it is not from a film
};

/// Detects boards in the pictures of a rig's cameras and collects the sightings for `CalibrateFromPlanes`. A moment is
/// a time at which several cameras take pictures. A board at one moment is one target: it may move between moments, but
/// all pictures of one moment show it at the same position.
class BoardViews {
 public:
  explicit BoardViews(std::vector<Board> boards) : boards_(std::move(boards)) {}
  /// Makes a collector that detects one of OpenCV's boards instead of ours.
  BoardViews(const PrintedBoard& board, std::unique_ptr<PrintedBoardFinder> finder)
      : boards_{{.columns = board.columns, .rows = board.rows, .square = board.square}}, printed_(std::move(finder)) {}

  /// Adds a picture of a camera. Fails if the picture's size differs from the size of the camera's earlier pictures.
  /// @param camera number of the camera, from 0
  /// @param moment name of the time at which the picture was taken: pictures of one moment show boards at the same
  /// positions
  /// @param look index among the examined, evenly spaced pictures of a film, from 0; −1 for a picture that is not from
  /// a film
  /// @return the number of corners found
  Result<std::size_t> Add(std::size_t camera, const std::string& moment, const ColourImage& picture, int look = -1);

  /// The sightings of all boards in all pictures, in the order of `Add`.
  const std::vector<BoardSighting>& sightings() const { return sightings_; }
  std::vector<TargetView> views() const;
  /// The picture size of each camera.
  const std::vector<PictureSize>& sizes() const { return sizes_; }
  /// Describes the detected properties of an OpenCV board (PrintedBoardFinder::Told); "" for our boards.
  std::string Told() const { return printed_ ? printed_->Told() : ""; }

 private:
  const std::vector<Board> boards_;
  std::unique_ptr<PrintedBoardFinder> printed_;
  std::map<std::pair<std::string, std::size_t>, std::size_t> targets_;  ///< index of the target by moment and board
  std::vector<BoardSighting> sightings_;
  std::vector<PictureSize> sizes_;
};

/// The pose of the first board, which defines the world of the cameras.
enum class BoardPlacement {
  kOnFloor,  ///< on the floor: X along the board's rows to the right, Z down the board's columns, Y up
  kOnWall,   ///< upright: X to the right, Y up the board's columns, Z out of the board's front
};

/// Transforms the cameras to a world with Y up and its origin at the top left corner of the first board.
void AlignToBoard(BoardPlacement stance, std::span<Camera> cameras);

}  // namespace etude
