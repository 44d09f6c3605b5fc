#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/training/genetic_search.h"
#include "bench/training/training_pairs.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

using ClipFrames = std::span<const std::vector<TrainingFrame>>;

/// The parts of the fuzzy system that are learnt, and the learning method.
enum class Tuning {
  kAdaptive,            ///< the weights, by logistic regression (engine/fuzzy/weights.h)
  kGenetic,             ///< the weights, by the genetic algorithm (genetic_search.h)
  kGeneticMemberships,  ///< weights and breakpoints of the membership functions together, by the genetic algorithm
};

struct TunedSystem {
  WeightFitStatus status = WeightFitStatus::kOneClassOnly;
  FuzzySystem system;  ///< paper A's system unless the status is kFitted
  int pairs = 0, close_pairs = 0;
  int generations = 0;  ///< number of generations of the genetic algorithm, or of Newton steps
};

/// Tunes paper A's fuzzy system so that "d < 0.4" separates the close pairs of these clips as well as possible (paper A
/// leaves this to future work; the methods are Etude's). `genetic` has no effect on kAdaptive.
TunedSystem TuneSystem(ClipFrames clips, Tuning tuning, const GeneticOptions& genetic = {});

/// The quality with which a system separates close pairs of frames from other pairs.
struct SystemScore {
  MatchScore at_threshold;    ///< the score at the threshold 0.4
  std::optional<double> auc;  ///< area under the curve over all thresholds; nullopt if all pairs are close, or none is
};
SystemScore ScoreSystem(ClipFrames clips, const FuzzySystem& system);

}  // namespace etude
