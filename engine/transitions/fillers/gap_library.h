#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// The motions from which fillers learn; none of them is judged. *(Ours, after motion matching.)*
///
/// Two gaps are compared by the mean over joints of squared distances: joints, tilt and height as seen from the root,
/// at both ends; their velocities and the root's at the first end, times 0.1 s; the root's displacement and rotation
/// between the ends. Only gaps of one joint tree, rate and length are compared.
class GapLibrary {
 public:
  /// A way to fill a gap that needs no library.
  using Fill = std::vector<TreePose> (*)(const Gap& gap);

  /// Adds a motion. It takes about 100 bytes per joint and frame.
  void Add(TreeMotion motion);

  /// Fills a gap by `fill`, plus what `fill` misses in the nearest gap of the library: each frame's displacement of the
  /// root, relative to the heading, and rotation of each joint. Of equally near gaps the first added is taken. Returns
  /// nothing if no gap can be compared.
  std::vector<TreePose> FillLikeNearest(const Gap& gap, Fill fill) const;

  /// Fills a gap by `fill`, plus the weighted mean of what `fill` misses in the library's gaps at most 0.36 m away; of
  /// gaps that overlap by more than half, the nearest counts. The weight is exp(−d²/2h²), h = 0.12 m; missing nothing
  /// counts with weight 2 (kernel regression, shrunk towards `fill`).
  std::vector<TreePose> FillLikeNear(const Gap& gap, Fill fill) const;

 private:
  struct Entry {
    TreeMotion motion;
    std::vector<double> seen;  ///< frames × features (AppendSeen)
  };
  /// A gap of the library: its motion, the frame before it, and its squared distance, m².
  struct Near {
    const Entry* entry = nullptr;
    std::size_t frame = 0;
    double squared = 0;
  };

  /// Calls `visit` with every gap that is at most the square root of `limit` away; `visit` may lower the limit.
  template <typename Visit>
  void ForEachNear(const Gap& gap, double& limit, const Visit& visit) const;
  /// Adds what `fill` misses in the gap `near`, times `share`, to `filled`.
  static void AddMissed(const Gap& gap, const Near& near, Fill fill, double share, std::vector<TreePose>& filled);

  std::vector<Entry> entries_;
};

}  // namespace etude
