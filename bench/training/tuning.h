#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/training/genetic_search.h"
#include "bench/training/training_pairs.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

using ClipFrames = std::span<const std::vector<TrainingFrame>>;

/// What is learnt, and how.
enum class Tuning {
  kAdaptive,            ///< the weights, by logistic regression (engine/fuzzy/weights.h)
  kGenetic,             ///< the weights, by the genetic algorithm (genetic_weights.h)
  kGeneticMemberships,  ///< weights and breakpoints of the membership functions together, by the same
};

struct TunedSystem {
  WeightFitStatus status = WeightFitStatus::kOneClassOnly;
  FuzzySystem system;  ///< unless kFitted, the one it started from
  int pairs = 0, close_pairs = 0;
  int generations = 0;  ///< or Newton steps
};

/// Paper A's fuzzy system tuned so that "d < 0.4" tells the close pairs of these clips (paper A names this as future
/// work; how is ours). `genetic` is of no use to kAdaptive.
TunedSystem TuneSystem(ClipFrames clips, Tuning tuning, const GeneticOptions& genetic = {});

/// How well a system tells the pairs of these clips.
struct SystemScore {
  MatchScore at_threshold;    ///< of 0.4
  std::optional<double> auc;  ///< whatever the threshold; nothing when all pairs are close, or none is
};
SystemScore ScoreSystem(ClipFrames clips, const FuzzySystem& system);

}  // namespace etude
