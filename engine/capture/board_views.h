#pragma once

#include <map>
#include <span>
#include <vector>

#include "engine/boards/board.h"
#include "engine/boards/find_boards.h"
#include "engine/cameras/planes.h"
#include "engine/cameras/refine.h"

namespace etude {

/// Collects what pictures show of boards, for `CalibrateFromPlanes`. A board at one moment is a target of its own: it
/// may be carried about between pictures, but pictures of one moment show it at one place.
class BoardViews {
 public:
  explicit BoardViews(std::vector<Board> boards) : boards_(std::move(boards)) {}

  /// @param moment when it was taken: pictures of the same moment show boards at the same places
  /// @return how many corners it shows
  std::size_t Add(std::size_t camera, std::size_t moment, const ColourImage& picture);

  const std::vector<TargetView>& views() const { return views_; }

 private:
  const std::vector<Board> boards_;
  std::map<std::pair<std::size_t, std::size_t>, std::size_t> targets_;  ///< of moment and board
  std::vector<TargetView> views_;
};

/// How the first board stands in the world that a rig shall be told in.
enum class BoardStance {
  kOnFloor,  ///< its front up: X along its rows to the right, Z down its columns, Y up
  kOnWall,   ///< upright: X to the right, Y up its columns, Z out of its front
};

/// The same cameras in a world with Y up, its origin at the top left corner of the first board's first square.
void TurnToStance(BoardStance stance, std::span<Camera> cameras);

}  // namespace etude
