#pragma once

#include <vector>

#include "engine/transitions/fillers/filler.h"

namespace etude {

/// Training motions from which fillers learn; motions on which fillers are evaluated may not be among them. *(Ours; the
/// search for similar frames is taken from motion matching.)*
///
/// The squared distance of two gaps, m², is a mean over the joints. It compares features in the root's frame: at both
/// ends of the gap, the joints' positions, the vertical direction and the root's height; at the first end also the
/// velocities of joints and root, times 0.1 s; and the root's displacement and rotation from the first end to the
/// second. Only gaps with the same joint tree, rate and length are compared.
class GapLibrary {
 public:
  /// A function that fills a gap without a library.
  using Fill = std::vector<TreePose> (*)(const Gap& gap);

  /// Adds a motion, which takes about 100 bytes of memory per joint and frame.
  void Add(TreeMotion motion);

  /// Fills a gap with `fill` and corrects the result by the error (truth minus filled) that `fill` makes in the nearest
  /// gap of the library. In each frame, the root's displacement, relative to the heading, and the rotation of each
  /// joint are corrected. On a tie, the gap that was added first is taken. Returns no frames if no gap can be compared.
  std::vector<TreePose> FillLikeNearest(const Gap& gap, Fill fill) const;

  /// Fills a gap with `fill` and corrects the result by a weighted mean of the errors (truth minus filled) that `fill`
  /// makes in those gaps of the library whose distance d is below 0.36 m (kernel regression). The weight is
  /// exp(−d²/2h²), h = 0.12 m. The mean includes an error of zero with weight 2, which shrinks the correction. Of gaps
  /// that overlap by more than half, only the nearest counts.
  std::vector<TreePose> FillLikeNear(const Gap& gap, Fill fill) const;

 private:
  struct Entry {
    TreeMotion motion;
    std::vector<double> seen;  ///< the features (AppendSeen) of every frame, frame by frame
  };
  /// A gap of the library: its motion, the frame before it, and its squared distance, m², from the gap to be filled.
  struct Near {
    const Entry* entry = nullptr;
    std::size_t frame = 0;
    double squared = 0;
  };

  /// Calls `visit` with every gap whose squared distance is below `limit`. `visit` may lower the limit.
  template <typename Visit>
  void ForEachNear(const Gap& gap, double& limit, const Visit& visit) const;
  /// Computes the errors that `fill` makes in the library's gap `near`, and adds `share` times these errors to
  /// `filled`.
  static void AddMissed(const Gap& gap, const Near& near, Fill fill, double share, std::vector<TreePose>& filled);

  std::vector<Entry> entries_;
};

}  // namespace etude
