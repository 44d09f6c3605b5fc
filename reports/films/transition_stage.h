#pragma once

#include <optional>
#include <vector>

#include "engine/motion/character.h"
#include "reports/films/studio.h"
#include "reports/films/transition_race.h"

namespace etude {

/// The place where all methods of a race are seen: one camera that stands still, everyone facing it at the request.
class TransitionStage {
 public:
  /// For pictures of this size that show the moments `first` … `last`, in frames after the request.
  TransitionStage(const TransitionRace& race, int first, int last, int width, int height);

  /// A path's frame; `ghost`, another frame of it, shimmers behind.
  ColourImage Picture(Renderer& renderer, const TransitionPath& path, std::size_t index, int frame,
                      std::optional<int> ghost) const;

 private:
  Sight SightOf(const TransitionRace& race, int first, int last) const;

  int width_, height_;
  Character bear_;
  std::vector<std::vector<FloorMove>> placements_;  ///< by path and frame
  Studio studio_;
};

}  // namespace etude
