#pragma once

#include <cstddef>
#include <vector>

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A frame of the playing clip, and the frame of the wanted clip that replaces it.
struct FramePair {
  int leave = 0, enter = 0;
};

/// A join that was played, and its cost.
struct PlayedJoin {
  FramePair pair;
  std::size_t number = 0;  ///< index of the pair
  std::size_t length = 0;  ///< index of the join's length in kLengths_s
  int frames = 0;          ///< length of the join
  JoinStyle way = JoinStyle::kDirect;
  bool carried = false;  ///< see PreferredJoin::carried
  double cost_s = 0;
  int unsupported = 0;  ///< length in frames of the longest run without support
};

/// The excess acceleration and the deviation that each cost as much as one second (PlayedOptions).
struct PlayedRates {
  double excess_per_s = 0, invented_per_s = 0;
};

/// Plays the joins of a request's clips at the given pairs (at least one): at every length, direct and as a fade
/// (PlayMinimumJerk), placed by the feet and by momentum (CarriedShift). Returns the joins that were played with
/// planted feet (PlantFeet), the best first. Only joins of the shortest length may end after frame `last` of the wanted
/// clip.
///
/// The method is best-first search (Hart, Nilsson and Raphael 1968): the join with the lowest cost so far is continued.
/// That cost first contains only the time, then also the costs of the limbs' movement, frame by frame, then those of
/// sliding feet and of missing support (FindSupport). Most joins are therefore never played to their end. Planting the
/// feet can raise or lower the cost, so only three fifths of the limbs' cost count before the feet are planted.
std::vector<PlayedJoin> PlayJoins(const MotionLibrary& library, const TransitionRequest& request,
                                  const PlayedRates& rates, const std::vector<FramePair>& pairs, int last);

}  // namespace etude
