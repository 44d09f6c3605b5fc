#pragma once

#include <span>
#include <vector>

#include "engine/transitions/bridge_frames/transition_points.h"
#include "engine/transitions/choices/fuzzy_rows.h"

namespace etude {

/// Which frames may be entered from a frame that is left: those with d below the rules' threshold. Frames that the
/// rules do not compare, being of another class, are left out.
class FuzzyGate {
 public:
  /// Clips and rules must outlive this.
  FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering, const MatchRules& rules);

  struct Compared {
    int to = 0;
    double distance = 0;
    bool matches = false;
  };
  /// Compares a frame of the playing clip with all that may be entered, in their order. Valid until the next call.
  std::span<const Compared> Compare(int from);

 private:
  const TaggedClip &playing_, &next_;
  std::vector<int> entering_;
  const MatchRules& rules_;
  FuzzyRows rows_;
  std::vector<double> distances_;
  std::vector<Compared> compared_;
};

}  // namespace etude
