#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// The motions from which fillers learn; none of them is judged. *(Ours, after motion matching.)*
///
/// The squared distance of two gaps is a mean over joints, m². It compares, in the root's frame, the joints' positions,
/// the vertical direction and the height at both ends; the velocities of these and of the root at the first end, times
/// 0.1 s; and the root's displacement and rotation between the ends. Only gaps of one joint tree, rate and length are
/// compared.
class GapLibrary {
 public:
  /// A way to fill a gap that needs no library.
  using Fill = std::vector<TreePose> (*)(const Gap& gap);

  /// Adds a motion. It takes about 100 bytes per joint and frame.
  void Add(TreeMotion motion);

  /// Fills a gap by `fill`, then adds the errors (truth minus `fill`) that `fill` makes in the nearest gap of the
  /// library: in each frame the root's displacement, relative to the heading, and the rotation of each joint. Of
  /// equally near gaps the first added is taken. Returns nothing if no gap can be compared.
  std::vector<TreePose> FillLikeNearest(const Gap& gap, Fill fill) const;

  /// Fills a gap by `fill`, then adds a weighted mean of the errors (truth minus `fill`) that `fill` makes in those
  /// gaps of the library that are at most 0.36 m away. The weight is exp(−d²/2h²), h = 0.12 m; an error of zero with
  /// weight 2 is averaged in, which shrinks the correction (kernel regression). Of gaps that overlap by more than half,
  /// only the nearest counts.
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
  /// Adds to `filled` the errors that `fill` makes in the gap `near`, times `share`.
  static void AddMissed(const Gap& gap, const Near& near, Fill fill, double share, std::vector<TreePose>& filled);

  std::vector<Entry> entries_;
};

}  // namespace etude
