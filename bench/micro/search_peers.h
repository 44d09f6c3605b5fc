#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/fuzzy/distance.h"
#include "engine/transitions/search/grade_index.h"

namespace etude {

/// A frame as a point whose Euclidean distances are equation 1's: √S·μ.
using GradePoint = std::array<double, kTermCount>;
GradePoint PointOf(const Grades& grades, const GradePoint& roots);
/// √S of every term.
GradePoint RootsOf(const FeatureWeights& weights);

/// The search that one would write: a loop over all frames in time order that stops adding up when a frame is too far.
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

/// A search of all frames with our vectors, sixteen at once: it shows how much the tree gives beyond them.
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
