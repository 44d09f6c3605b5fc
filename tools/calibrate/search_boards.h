#pragma once

#include <cstddef>
#include <string>

#include "engine/boards/board_views.h"
#include "tools/calibrate/calibrate_rig.h"

namespace etude {

/// The boards found in the pictures of one camera.
struct CameraBoards {
  std::string name;
  std::size_t looked = 0, with_board = 0, corners = 0;
  double period_s = 0;  ///< time between two searched frames of a film; 0 for a folder of pictures
  int every = 1;
  ColourImage best;  ///< the picture with the most corners
  std::size_t most_corners = 0;
};

/// Prepares the search for the board that the options name: a board as OpenCV defines it, or one of Etude's coded
/// boards.
Result<BoardViews> SearchFor(const CalibrateOptions& options);

/// Searches the pictures of camera `camera`, a folder or a film, for boards, and adds the boards' views.
Result<CameraBoards> SearchInput(std::size_t camera, const CalibrateOptions& options, BoardViews& views);

}  // namespace etude
