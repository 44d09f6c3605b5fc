#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_index.h"

namespace etude {

/// A frame as a point with coordinates √S·μ: the Euclidean distance of two points is the distance of equation 1.
using GradePoint = std::array<double, kTermCount>;
GradePoint PointOf(const Grades& grades, const GradePoint& roots);
GradePoint RootsOf(const FeatureWeights& weights);

/// The simple search: a loop over all frames in time order, which stops summing as soon as a frame is too far.
class LoopPeer {
 public:
  LoopPeer(std::span<const Grades> frames, const FeatureWeights& weights);
  std::optional<Neighbour> First(const Grades& query, double threshold) const;
  std::vector<Neighbour> Within(const Grades& query, double threshold) const;
  std::vector<Neighbour> Nearest(const Grades& query, int k) const;

 private:
  GradePoint roots_;
  std::vector<GradePoint> points_;
};

/// A search of all frames by our SIMD kernel, sixteen at once. The difference to the index shows how much the tree
/// saves.
class VectorLoopPeer {
 public:
  VectorLoopPeer(std::span<const Grades> frames, const FeatureWeights& weights);
  std::optional<Neighbour> First(const Grades& query, double threshold) const;
  std::vector<Neighbour> Within(const Grades& query, double threshold) const;
  std::vector<Neighbour> Nearest(const Grades& query, int k) const;

 private:
  GradeMetric metric_;
  int frame_count_ = 0;
  std::vector<FrameBlock> blocks_;
};

}  // namespace etude
