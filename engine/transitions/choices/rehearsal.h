#pragma once

#include <cstddef>
#include <vector>

#include "engine/transitions/library/library.h"
#include "engine/transitions/transition_record.h"

namespace etude {

/// A frame of the playing clip and one of the wanted clip, which count as one.
struct FramePair {
  int leave = 0, enter = 0;
};

/// A transition that was played, and what it cost.
struct PlayedWay {
  FramePair pair;
  std::size_t number = 0;  ///< of the pair
  int frames = 0;          ///< of the join
  JoinWay way = JoinWay::kDirect;
  double cost_s = 0;
  int unsupported = 0;  ///< frames, the most in a row that nothing holds up
};

/// The worth of a second (PlayedOptions).
struct PlayedRates {
  double excess_per_s = 0, invented_per_s = 0;
};

/// Plays the ways to join the clips of a request at any of these pairs, of which there must be one, at every length and
/// both direct and by a fade (PlayMinimumJerk), and returns those that were played with their feet (PlantFeet), the
/// best first. The joins end by frame `last` of the wanted clip, as far as the shortest one can.
///
/// Best first (Hart, Nilsson and Raphael 1968): what is played on is always the way that has cost least so far, first
/// its time alone, then its limbs frame by frame, then its feet, and what FindSupport says of the frames shown. So most
/// ways are never played to their end. Feet can make a way dearer or cheaper: limbs count for three fifths until then.
std::vector<PlayedWay> PlayWays(const MotionLibrary& library, const TransitionRequest& request,
                                const PlayedRates& rates, const std::vector<FramePair>& pairs, int last);

}  // namespace etude
