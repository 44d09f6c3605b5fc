#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// The motions from which `nearest-gap` takes its gaps; none of them is judged. *(Ours, after motion matching.)*
class GapLibrary {
 public:
  /// Adds a motion. It takes about 100 bytes per joint and frame.
  void Add(TreeMotion motion);

  /// Returns the frames of the library's nearest gap, moved and turned about the vertical axis so that its first end
  /// has the root position and heading of the last past frame. The differences that remain at both ends are spread over
  /// the gap by a movement of minimum jerk. The nearest gap has the least sum of squared differences of: joints, tilt
  /// and height as seen from the root, at both ends; their velocities and the root's at the first end, times 0.1 s; the
  /// root's displacement and rotation between the ends. Of equally near gaps the first added is taken. Returns nothing
  /// if no motion of the same tree and rate has a gap of that length.
  std::vector<TreePose> Fill(const Gap& gap) const;

 private:
  struct Entry {
    TreeMotion motion;
    std::vector<double> seen;  ///< frames × features (AppendSeen)
  };

  const Entry* FindNearest(const Gap& gap, std::size_t& frame) const;

  std::vector<Entry> entries_;
};

}  // namespace etude
