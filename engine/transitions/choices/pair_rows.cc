#include "engine/transitions/choices/pair_rows.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace etude {

FuzzyRows::FuzzyRows(std::span<const Grades> frames, const FeatureWeights& weights)
    : metric_(weights), blocks_(static_cast<std::size_t>(BlocksFor(frames.size()))) {
  for (std::size_t f = 0; f < frames.size(); ++f) {
    blocks_[f / kBlockLanes].Set(static_cast<int>(f % kBlockLanes), frames[f]);
  }
}

void FuzzyRows::Compute(const Grades& grades, std::span<double> distances) const {
  constexpr double kAll = std::numeric_limits<double>::infinity();
  for (std::size_t first = 0; first < distances.size(); first += kBlockLanes) {
    const BlockResult block = SquaredDistances(metric_, grades, blocks_[first / kBlockLanes], kAll);
    const std::size_t count = std::min<std::size_t>(kBlockLanes, distances.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) distances[first + lane] = std::sqrt(block.squared[lane]);
  }
}

FuzzyWindowRows::FuzzyWindowRows(std::span<const Grades> playing, std::span<const Grades> next, int first_leave_frame,
                                 int reach, const FeatureWeights& weights)
    : playing_(playing),
      next_frames_(static_cast<int>(next.size())),
      reach_(reach),
      rows_(next, weights),
      distances_(std::max(first_leave_frame - reach, 0), next_frames_, 2 * reach + 2) {}

void FuzzyWindowRows::Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) {
  const int playing_frames = static_cast<int>(playing_.size());
  while (distances_.NextRow() <= std::min(leave_frame + reach_, playing_frames - 1)) {
    const std::span<double> row = distances_.OpenRow();
    rows_.Compute(playing_[distances_.NextRow()], row);
    distances_.CloseRow();
  }
  for (std::size_t i = 0; i < enter_frames.size(); ++i) {
    const int enter = enter_frames[i];
    const Reach around = ReachAround(leave_frame, playing_frames, enter, next_frames_, reach_);
    const double sum = distances_.SumEndingAt(leave_frame + around.after, enter + around.after, around.Count());
    costs[i] = sum / around.Count();
  }
}

namespace {

/// Returns the floor point below the hips. The positions of a clip are stored relative to this point in one of the
/// clip's frames, so that sums of squares keep their precision. Heights are not shifted, because they are compared.
glm::dvec3 OnFloor(const BodyPose& pose) { return {pose[Role::kHipCentre].x, 0, pose[Role::kHipCentre].z}; }

int HalfWindow(double window_s, double rate_hz) { return static_cast<int>(std::lround(0.5 * window_s * rate_hz)); }

}  // namespace

PointCloudRows::PointCloudRows(const BodyMotion& playing, const BodyMotion& next, int first_leave_frame,
                               double window_s)
    : playing_(playing),
      next_frames_(static_cast<int>(next.poses.size())),
      half_(HalfWindow(window_s, playing.rate_hz)),
      first_frame_(std::max(first_leave_frame - half_, 0)),
      playing_origin_(OnFloor(playing.poses[first_leave_frame])),
      blocks_((next.poses.size() + kLanes - 1) / kLanes),
      playing_sums_{CloudSum{}},
      next_sums_{CloudSum{}},
      products_(first_frame_, static_cast<int>(next.poses.size()), 2 * half_ + 2) {
  const glm::dvec3 next_origin = OnFloor(next.poses.front());
  for (std::size_t f = 0; BodyPose pose : next.poses) {
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      pose.joints[j] -= next_origin;
      for (int axis = 0; axis < 3; ++axis) blocks_[f / kLanes][j][axis][f % kLanes] = pose.joints[j][axis];
    }
    next_sums_.push_back(Plus(next_sums_.back(), pose));
    ++f;
  }
}

PointCloudRows::CloudSum PointCloudRows::Plus(CloudSum sum, const BodyPose& pose) {
  for (const glm::dvec3& point : pose.joints) {
    sum.x += point.x;
    sum.z += point.z;
    sum.square += glm::dot(point, point);
  }
  return sum;
}

void PointCloudRows::AddFrame(int frame) {
  BodyPose pose = playing_.poses[frame];
  for (glm::dvec3& joint : pose.joints) joint -= playing_origin_;
  playing_sums_.push_back(Plus(playing_sums_.back(), pose));
  const std::span<glm::dvec3> row = products_.OpenRow();
  // Sum the products of this frame's joints with the joints of eight frames of the wanted clip at a time.
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    std::array<double, kLanes> along{}, across{}, up{};
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3& p = pose.joints[j];
      const auto& [x, y, z] = blocks_[b][j];
#pragma GCC unroll 8
      for (std::size_t lane = 0; lane < kLanes; ++lane) {
        along[lane] += p.x * x[lane] + p.z * z[lane];
        across[lane] += p.x * z[lane] - p.z * x[lane];
        up[lane] += p.y * y[lane];
      }
    }
    const std::size_t first = b * kLanes, count = std::min(kLanes, row.size() - first);
    for (std::size_t lane = 0; lane < count; ++lane) row[first + lane] = {along[lane], across[lane], up[lane]};
  }
  products_.CloseRow();
}

void PointCloudRows::Compute(int leave_frame, std::span<const int> enter_frames, std::span<double> costs) {
  const int playing_frames = static_cast<int>(playing_.poses.size());
  for (std::size_t i = 0; i < enter_frames.size(); ++i) {
    const int enter = enter_frames[i];
    const Reach reach = ReachAround(leave_frame, playing_frames, enter, next_frames_, half_);
    // Compute sums over the two clouds: of coordinates, and of products of equal points.
    const int row = leave_frame + reach.after, column = enter + reach.after;
    while (products_.NextRow() <= row) AddFrame(products_.NextRow());
    const glm::dvec3 of_pair = products_.SumEndingAt(row, column, reach.Count());
    const auto of_cloud = [&](const std::vector<CloudSum>& sums, int last) {
      const CloudSum &end = sums[last + 1], &begin = sums[last + 1 - reach.Count()];
      return CloudSum{end.x - begin.x, end.z - begin.z, end.square - begin.square};
    };
    const CloudSum p = of_cloud(playing_sums_, row - first_frame_), q = of_cloud(next_sums_, column);
    const double share = 1.0 / (static_cast<double>(kRoleCount) * reach.Count());  // weight of one point
    // Kovar's closed form: the best shift aligns the clouds' centroids, and the best rotation maximises the remaining
    // correlation.
    const double along = of_pair[0] - (p.x * q.x + p.z * q.z) * share;
    const double across = of_pair[1] - (p.x * q.z - p.z * q.x) * share;
    const double of_p = p.square - (p.x * p.x + p.z * p.z) * share;
    const double of_q = q.square - (q.x * q.x + q.z * q.z) * share;
    const double squares = of_p + of_q - 2 * of_pair[2] - 2 * std::sqrt(along * along + across * across);
    constexpr double kCentimetres = 100;
    costs[i] = kCentimetres * std::sqrt(std::max(squares, 0.0) * share);
  }
}

}  // namespace etude
