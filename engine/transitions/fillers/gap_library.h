#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// The motions of which `nearest-gap` takes its gaps: not those that are judged. *(Ours, after motion matching.)*
class GapLibrary {
 public:
  /// Adds a motion, about 100 bytes a joint and frame.
  void Add(TreeMotion motion);

  /// Returns the frames of the nearest gap, turned and moved over the floor so that its first end has the heading and
  /// position of the last past frame; what is still wrong at either end is spread over the gap by a movement of minimum
  /// jerk. The nearest has the least sum of squares of: what is seen from the root at both ends (joints, tilt, height);
  /// its velocity and the root's at the first, times 0.1 s; the root's way and turn between the ends. Of equally near
  /// ones the first added is taken. None if no motion has a gap of that length on the same tree.
  std::vector<TreePose> Fill(const Gap& gap) const;

 private:
  struct Entry {
    TreeMotion motion;
    std::vector<double> seen;  ///< frames × what is seen from the root
  };

  const Entry* FindNearest(const Gap& gap, std::size_t& frame) const;

  std::vector<Entry> entries_;
};

}  // namespace etude
