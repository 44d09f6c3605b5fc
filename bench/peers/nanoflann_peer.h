#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "bench/peers/search_peers.h"

namespace etude {

/// nanoflann's k-d tree over GradePoints, in double.
class NanoflannPeer {
 public:
  NanoflannPeer(std::span<const Grades> frames, const FeatureWeights& weights, int leaf_size);
  ~NanoflannPeer();
  /// Keeps the first frame in time order during the search.
  std::optional<Neighbour> First(const Grades& query, double threshold) const;
  std::vector<Neighbour> Within(const Grades& query, double threshold) const;
  std::vector<Neighbour> Nearest(const Grades& query, int k) const;
  std::size_t Bytes() const;

 private:
  struct Tree;
  GradePoint roots_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace etude
