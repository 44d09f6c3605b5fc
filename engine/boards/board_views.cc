#include "engine/boards/board_views.h"

namespace etude {

Result<std::size_t> BoardViews::Add(std::size_t camera, const std::string& moment, const ColourImage& picture,
                                    int look) {
  if (camera >= sizes_.size()) sizes_.resize(camera + 1);
  PictureSize& size = sizes_[camera];
  if (size.width == 0) size = {picture.width, picture.height};
  if (size.width != picture.width || size.height != picture.height) {
    return Fail({}, "this picture has {} x {} pixels, but earlier pictures of the same camera have {} x {}",
                picture.width, picture.height, size.width, size.height);
  }
  const std::vector<SeenCorner> corners = printed_ ? printed_->Find(picture) : FindBoards(picture, boards_);
  std::map<std::size_t, TargetView> by_board;
  for (const SeenCorner& corner : corners) {
    const glm::dvec2 position = PlaceOf(boards_[corner.board], corner.corner);
    by_board[corner.board].pairs.push_back({{position.x, position.y, 0}, corner.pixel});
  }
  for (auto& [board, view] : by_board) {
    view.camera = camera;
    view.target = targets_.try_emplace({moment, board}, targets_.size()).first->second;
    sightings_.push_back({std::move(view), board, look});
  }
  return corners.size();
}

std::vector<TargetView> BoardViews::views() const {
  std::vector<TargetView> views;
  for (const BoardSighting& sighting : sightings_) views.push_back(sighting.view);
  return views;
}

void AlignToBoard(BoardPlacement stance, std::span<Camera> cameras) {
  // Seen from the front, the board's frame has x to the right, y down, and z into the board. The columns are these axes
  // in the world.
  const glm::dmat3 R_WT = stance == BoardPlacement::kOnFloor
                              ? glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0))
                              : glm::dmat3(glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));
  for (Camera& camera : cameras) {
    camera.R_CW = camera.R_CW * glm::transpose(R_WT);
    camera.p_WC = R_WT * camera.p_WC;
  }
}

}  // namespace etude
