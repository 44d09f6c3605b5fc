#pragma once

#include <array>
#include <vector>

#include "engine/motion/body.h"
#include "engine/transitions/choices/diagonal_sums.h"
#include "engine/transitions/choices/pair_rows.h"

namespace etude {

/// Kovar, Gleicher and Pighin's distance of two frames ("Motion graphs", 2002, section 3.1): the twenty joints of all
/// frames around the one, as a cloud of points, against those around the other, after the turn about the vertical and
/// the shift on the floor that lay the one cloud best onto the other (in closed form). All points weigh the same, and
/// the cost is the root mean square of their distances, centimetres; so clouds cut short by a clip's end compare, too.
///
/// In the paper the one cloud begins and the other ends at the frame, since they are crossfaded there; here the pair is
/// in the middle, since a cut is.
class PointCloudRows : public PairRows {
 public:
  /// Rows begin at `first_leave_frame`; `playing` must outlive this.
  PointCloudRows(const BodyMotion& playing, const BodyMotion& next, int first_leave_frame, double window_s);
  void Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) override;

 private:
  /// What a cloud adds up by itself, over all frames before one.
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
  /// Σ xx′ + zz′ (along), Σ xz′ − zx′ (across) and Σ yy′ (up) over the points of two frames.
  DiagonalSums<glm::dvec3> products_;
};

}  // namespace etude
