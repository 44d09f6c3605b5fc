#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "bench/training/training_clips.h"
#include "bench/training/training_pairs.h"

namespace etude {

/// The `adaptive` weights of each pair of judged clips, learnt from all other clips: a weight never
/// saw what it is judged by. Remembers what it has learnt, because trials meet the same pairs again.
class AdaptiveWeights {
 public:
  /// `training` must outlive this.
  explicit AdaptiveWeights(const TrainingClips& training);

  /// Learnt without the two clips of these identities.
  const WeightFit& Without(const std::string& judged_a, const std::string& judged_b);

 private:
  TrainingClip ClipAt(std::size_t index) const;

  const TrainingClips& training_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<LabelledPair>> pairs_;
  std::map<std::pair<std::string, std::string>, WeightFit> fits_;
};

}  // namespace etude
