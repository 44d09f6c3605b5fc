#include "engine/capture/agreeing_marks.h"

#include <algorithm>

#include "engine/cameras/agreeing_views.h"

namespace etude {
namespace {

/// Takes one mark of one frame out of the pictures that disagree about it. `mark_of(camera)`: where it is kept.
template <typename View, typename MarkOf>
void KeepAgreeing(std::span<const ProjectionMatrix> cameras, double tolerance_px, const MarkOf& mark_of) {
  std::vector<View> views;
  std::vector<std::size_t> by;
  for (std::size_t camera = 0; camera < cameras.size(); ++camera) {
    if (!mark_of(camera)) continue;
    views.push_back({cameras[camera], *mark_of(camera)});
    by.push_back(camera);
  }
  const std::vector<std::size_t> kept = AgreeingViews(views, tolerance_px);
  for (std::size_t view = 0; view < views.size(); ++view) {
    if (!std::ranges::binary_search(kept, view)) mark_of(by[view]).reset();
  }
}

}  // namespace

std::vector<std::vector<Marks>> AgreeingMarks(std::span<const ProjectionMatrix> cameras,
                                              std::span<const std::vector<Marks>> marks, double tolerance_px) {
  std::vector<std::vector<Marks>> agreeing(marks.begin(), marks.end());
  for (std::size_t frame = 0; frame < agreeing.front().size(); ++frame) {
    for (std::size_t i = 0; i < kEffectorCount; ++i) {
      KeepAgreeing<Sighting>(
          cameras, tolerance_px, [&](std::size_t camera) -> auto& { return agreeing[camera][frame].effectors[i]; });
    }
    for (std::size_t i = 0; i < kStrokeCount; ++i) {
      KeepAgreeing<LimbSighting>(
          cameras, tolerance_px, [&](std::size_t camera) -> auto& { return agreeing[camera][frame].strokes[i]; });
    }
  }
  return agreeing;
}

}  // namespace etude
