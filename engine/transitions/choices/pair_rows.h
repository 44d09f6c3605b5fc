#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/motion/body.h"
#include "engine/transitions/search/grade_blocks.h"

namespace etude {

/// Computes one kind of cost for pairs of frames, row by row; a row contains all pairs of one frame that may be left.
/// Rows must be requested in ascending order of that frame.
class PairRows {
 public:
  virtual ~PairRows() = default;
  /// Computes the costs of leaving at `leave_frame` and entering at each of `enter_frames`; `costs` has the same size.
  virtual void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) = 0;
};

/// Keeps running sums along the diagonals of a table. The table's rows are frames of one clip, its columns are frames
/// of another clip; along a diagonal, both clips advance by one frame per cell. The sum over any stretch of a diagonal
/// takes two look-ups. Rows are added one by one. `Value` is a number or a vector of numbers.
template <class Value>
class DiagonalSums {
 public:
  /// To limit the memory, keeps only the last `depth` rows (`depth` is rounded up to a power of two). The first row is
  /// number `first_row`.
  DiagonalSums(int first_row, int columns, int depth)
      : first_row_(first_row),
        next_row_(first_row),
        columns_(columns),
        depth_(static_cast<int>(std::bit_ceil(static_cast<unsigned>(depth)))),
        sums_(static_cast<std::size_t>(columns) * static_cast<std::size_t>(depth_)) {}

  /// Returns the memory for the next row's values; CloseRow then adds them to the sums.
  std::span<Value> OpenRow() { return Row(next_row_); }
  void CloseRow() {
    if (next_row_ > first_row_) {
      const std::span<Value> above = Row(next_row_ - 1), row = Row(next_row_);
      for (std::size_t c = 1; c < row.size(); ++c) row[c] += above[c - 1];
    }
    ++next_row_;
  }
  int NextRow() const { return next_row_; }

  /// Returns the sum of the `count` values on the diagonal that ends at (row, column), which must lie in the table. Row
  /// `row` − `count` must still be kept, or lie before the first row.
  Value SumEndingAt(int row, int column, int count) const { return At(row, column) - At(row - count, column - count); }

 private:
  std::size_t Start(int row) const {
    return static_cast<std::size_t>((row - first_row_) & (depth_ - 1)) * static_cast<std::size_t>(columns_);
  }
  std::span<Value> Row(int row) { return std::span(sums_).subspan(Start(row), static_cast<std::size_t>(columns_)); }
  /// Returns the sum of the diagonal up to this cell; 0 outside the table.
  Value At(int row, int column) const {
    if (row < first_row_ || column < 0) return Value(0);
    assert(row < next_row_ && row >= next_row_ - depth_ && column < columns_);
    return sums_[Start(row) + static_cast<std::size_t>(column)];
  }

  int first_row_, next_row_, columns_;
  int depth_;                ///< a power of two, so that ring indices need no division
  std::vector<Value> sums_;  ///< ring buffer of rows; each entry is the sum of the diagonal up to its cell
};

/// The numbers of frames before a pair and after it that exist in both clips, each at most half a window.
struct Reach {
  int before = 0, after = 0;

  int Count() const { return before + 1 + after; }
};
inline Reach ReachAround(int frame_a, int frames_a, int frame_b, int frames_b, int half) {
  return {.before = std::min({half, frame_a, frame_b}),
          .after = std::min({half, frames_a - 1 - frame_a, frames_b - 1 - frame_b})};
}

/// Computes the fuzzy distance (paper A, equation 1) from one frame to many frames with SIMD instructions. The values
/// are bit-identical to those of ComputeDistance.
class FuzzyRows {
 public:
  FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights);

  /// Computes the distances from `grades` to the first `distances.size()` frames.
  void Compute(const Grades& grades, std::span<double> distances) const;

 private:
  GradeMetric metric_;
  std::vector<FrameBlock> blocks_;
};

/// Computes, for each pair of a row, the mean fuzzy distance (paper A, equation 1) over the frames up to `reach` before
/// and after the pair, as far as both clips have such frames. Overlapping windows share the comparisons of frames.
class FuzzyWindowRows : public PairRows {
 public:
  /// Compute accepts frames from `first_leave_frame` on. The playing clip's grades must outlive this object.
  FuzzyWindowRows(std::span<const Grades> playing, std::span<const Grades> next, int first_leave_frame, int reach,
                  const FeatureWeights& weights);
  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override;

 private:
  std::span<const Grades> playing_;
  int next_frames_, reach_;
  FuzzyRows rows_;
  DiagonalSums<double> distances_;
};

/// Computes the distance of two frames by Kovar, Gleicher and Pighin ("Motion graphs", 2002, section 3.1). The twenty
/// joints of all frames in a window form a point cloud. One cloud is rotated about the vertical and shifted on the
/// floor to fit the other cloud best (in closed form). All points have the same weight. The cost is the root mean
/// square distance, in centimetres, of a point of one cloud from the same point of the other. Windows that a clip's end
/// shortens are therefore comparable with whole windows.
///
/// In the paper one cloud begins at its frame and the other ends at its frame, because the clips are crossfaded. Here
/// both clouds are centred on their frames, because the clips are cut there.
class PointCloudRows : public PairRows {
 public:
  /// Compute accepts frames from `first_leave_frame` on. `playing` must outlive this object.
  PointCloudRows(const BodyMotion& playing, const BodyMotion& next, int first_leave_frame, double window_s);
  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override;

 private:
  /// Sums over all points in the frames before a given frame: of x, of z, and of the squared distance from the origin.
  struct CloudSum {
    double x = 0, z = 0, square = 0;
  };
  static CloudSum Plus(CloudSum sum, const BodyPose& pose);
  void AddFrame(int frame);

  static constexpr std::size_t kLanes = 8;
  using Block = std::array<std::array<std::array<double, kLanes>, 3>, kRoleCount>;  ///< [joint][x, y, z][frame]

  const BodyMotion& playing_;
  int next_frames_, half_, first_frame_;
  glm::dvec3 playing_origin_;
  std::vector<Block> blocks_;
  std::vector<CloudSum> playing_sums_, next_sums_;
  /// Sums over the pairs of equal joints in two frames, (x, y, z) in one and (x′, y′, z′) in the other: Σ xx′ + zz′
  /// (along), Σ xz′ − zx′ (across) and Σ yy′ (up).
  DiagonalSums<glm::dvec3> products_;
};

}  // namespace etude
