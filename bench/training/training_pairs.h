#pragma once

#include <span>
#include <vector>

#include "bench/training/training_clips.h"
#include "engine/fuzzy/membership.h"
#include "engine/fuzzy/weights.h"

namespace etude {

/// Every pair of a frame of `a` and one of `b`, labelled close when its true pose gap is below kCloseGap.
std::vector<LabelledPair> LabelPairs(std::span<const TrainingFrame> a, std::span<const TrainingFrame> b,
                                     const Memberships& memberships = PaperMemberships());

/// The pairs of all these clips, two different clips each.
std::vector<LabelledPair> LabelPairsAcross(std::span<const std::vector<TrainingFrame>> clips,
                                           const Memberships& memberships = PaperMemberships());

/// Puts other memberships' gaps into the pairs that LabelPairsAcross made of the same clips: much quicker, because
/// poses are not compared again.
void GradeAnew(std::span<const std::vector<TrainingFrame>> clips, const Memberships& memberships,
               std::span<LabelledPair> pairs);

}  // namespace etude
