#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "bench/tasks/evaluation/common_joints.h"

namespace etude {

/// Compares distances between joints, on which a file's origin, axes and root have no effect. At most eight joints and
/// 150 frames of the truth, evenly chosen, are compared.
class DistanceComparison {
 public:
  DistanceComparison(const JudgedSide& truth, const JudgedSide& answer) {
    constexpr std::size_t kMaxFrames = 150;
    const auto chosen = [](const JudgedSide& side) {
      const std::size_t count = std::min(side.joints.size(), kMaxJoints);
      std::vector<int> joints;
      for (std::size_t i = 0; i < count; ++i) joints.push_back(side.joints[i * side.joints.size() / count]);
      return JointColumns(side.motion, joints, side.motion.FrameCount());
    };
    answer_ = chosen(answer);
    const PointTracks all = chosen(truth);
    stride_ = 1 + all.FrameCount() / kMaxFrames;
    true_ = DistancesEvery(stride_, all);
  }

  struct Difference {
    double rms_m = std::numeric_limits<double>::infinity(), count = 0;
  };

  /// Compares frame f of the truth with the answer's frame nearest to `at(f)`. The mean difference of each pair of
  /// joints is left out, because bodies differ.
  template <typename At>
  Difference Compare(const At& at) const {
    std::array<double, kMaxPairs> counts{}, sums{}, squares{};
    for (std::size_t i = 0; i < true_.size(); ++i) {
      const double frame = std::round(at(static_cast<double>(i * stride_)));
      if (frame < 0 || frame >= static_cast<double>(answer_.FrameCount())) continue;
      const auto found = DistancesAt(answer_.Frame(static_cast<std::size_t>(frame)));
      for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
        const double difference = found[pair] - true_[i][pair];
        if (std::isnan(difference)) continue;
        counts[pair] += 1;
        sums[pair] += difference;
        squares[pair] += difference * difference;
      }
    }
    double sum = 0, count = 0;
    for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
      if (counts[pair] > 0) sum += std::max(0.0, squares[pair] - sums[pair] * sums[pair] / counts[pair]);
      count += counts[pair];
    }
    if (count == 0) return {};
    return {std::sqrt(sum / count), count};
  }

  std::size_t FrameCount() const { return true_.size(); }  ///< number of compared frames of the truth
  double FrameAt(std::size_t i) const { return static_cast<double>(i * stride_); }  ///< which frame of the truth

  /// Returns, for each compared frame f of the truth and each shift, the mean squared difference in m² from the
  /// answer's frame nearest to `at(f, shift)`; NaN where nothing can be compared. The differences of the pairs' mean
  /// distances are left out, because bodies differ.
  template <typename At>
  std::vector<double> SquaresByShift(std::size_t shifts, const At& at) const {
    constexpr std::size_t kMeanFrames = 2000;  // more hardly change a mean
    const auto true_means = MeansOf(true_),
               found_means = MeansOf(DistancesEvery(1 + answer_.FrameCount() / kMeanFrames, answer_));
    std::vector<double> all;
    for (std::size_t i = 0; i < true_.size(); ++i) {
      for (std::size_t shift = 0; shift < shifts; ++shift) {
        const double frame = std::round(at(FrameAt(i), shift));
        if (frame < 0 || frame >= static_cast<double>(answer_.FrameCount())) {
          all.push_back(std::nan(""));
          continue;
        }
        const Distances found = DistancesAt(answer_.Frame(static_cast<std::size_t>(frame)));
        double squares = 0, seen = 0;
        for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
          const double difference = (found[pair] - found_means[pair]) - (true_[i][pair] - true_means[pair]);
          if (std::isnan(difference)) continue;
          squares += difference * difference;
          seen += 1;
        }
        all.push_back(squares / seen);  // NaN if nothing was seen
      }
    }
    return all;
  }

 private:
  static constexpr std::size_t kMaxJoints = 8, kMaxPairs = kMaxJoints * (kMaxJoints - 1) / 2;
  using Distances = std::array<double, kMaxPairs>;

  static Distances DistancesAt(std::span<const glm::dvec3> joints) {
    Distances distances{};
    distances.fill(std::nan(""));
    std::size_t pair = 0;
    for (std::size_t a = 0; a < joints.size(); ++a) {
      for (std::size_t b = 0; b < a; ++b) distances[pair++] = glm::distance(joints[a], joints[b]);
    }
    return distances;
  }

  static std::vector<Distances> DistancesEvery(std::size_t stride, const PointTracks& tracks) {
    std::vector<Distances> all;
    for (std::size_t f = 0; f < tracks.FrameCount(); f += stride) all.push_back(DistancesAt(tracks.Frame(f)));
    return all;
  }

  static Distances MeansOf(const std::vector<Distances>& all) {
    Distances sums{}, counts{};
    for (const Distances& distances : all) {
      for (std::size_t pair = 0; pair < kMaxPairs; ++pair) {
        if (std::isnan(distances[pair])) continue;
        sums[pair] += distances[pair];
        counts[pair] += 1;
      }
    }
    for (std::size_t pair = 0; pair < kMaxPairs; ++pair) sums[pair] /= counts[pair];
    return sums;
  }

  PointTracks answer_;
  std::size_t stride_ = 1;
  std::vector<Distances> true_;
};

}  // namespace etude
