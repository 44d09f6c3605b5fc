#pragma once

#include <map>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "bench/training/training_pairs.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// The source of the weights S in paper A's equation 1.
enum class WeightSource {
  kFixed,     ///< the fuzzy system's own weights: paper A's, unless a file sets others
  kAdaptive,  ///< weights learnt by logistic regression (engine/fuzzy/weights.h)
  kGenetic,   ///< weights learnt by a genetic algorithm (genetic_search.h)
};

/// Returns the names "fixed", "adaptive", "genetic".
std::vector<std::string> WeightSourceNames();
/// Returns the source with this name. `name` must be one of WeightSourceNames.
WeightSource FindWeightSource(std::string_view name);

/// The weights for each pair of judged clips. They are learnt from all other clips, so weights are never judged on
/// their training data. Fits are cached, because several trials use the same pair. A result depends only on the
/// arguments of the call, so the number of workers has no effect.
class LearntWeights {
 public:
  explicit LearntWeights(TrainingClips training, const FuzzySystem& system = {});

  /// Returns the weights of `source` for a transition between clips of these identities, in either order. If nothing
  /// could be learnt, returns the fuzzy system's own weights.
  const FeatureWeights& For(WeightSource source, const std::string& judged_a, const std::string& judged_b);

  /// Returns the fit whose weights `For()` returns for these clips. `source` must not be kFixed.
  const WeightFit& FitOf(WeightSource source, const std::string& judged_a, const std::string& judged_b);

 private:
  const std::vector<LabelledPair>& PairsOf(std::size_t clip_a, std::size_t clip_b);
  std::vector<LabelledPair> PairsWithout(const std::string& judged_a, const std::string& judged_b);

  const TrainingClips training_;
  const FuzzySystem system_;
  std::map<std::pair<std::size_t, std::size_t>, std::vector<LabelledPair>> pairs_;
  std::map<std::tuple<WeightSource, std::string, std::string>, WeightFit> fits_;
};

}  // namespace etude
