#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "engine/base/embedded_text.h"
#include "engine/base/result.h"
#include "engine/recognition/boosted_trees.h"
#include "engine/recognition/measuring_recogniser.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// A model learnt from right and faulty performances of any move, kept in a file so that nobody need train.
struct LearntModel {
  BoostedTrees asked, spotted;
};

/// Reads the text of a model file (`etude train --recogniser`); `file` is what complaints call it.
Result<LearntModel> ReadLearntModel(std::string_view text, const std::string& file);
/// The text that ReadLearntModel reads back to the same model, to the last bit.
std::string WriteLearntModel(const LearntModel& model);

/// Returns the files scenarios/recognisers/*.yaml (written by the build).
std::span<const EmbeddedText> BuiltinLearntModelFiles();
/// Returns the model of recogniser `learnt`: scenarios/recognisers/learnt.yaml.
const LearntModel& BuiltinLearntModel();
/// Returns the model of recogniser `coached`: scenarios/recognisers/coached.yaml of performances asked for, learnt.yaml
/// of others.
const LearntModel& BuiltinCoachedModel();

/// Makes our learnt recogniser: performances are aligned with the taught examples, measured, and judged by what
/// simulated people taught the model; what is farther from every example than nearly all that taught it is no move at
/// all. The moves are those taught: the model knows none.
std::unique_ptr<Recogniser> MakeLearntRecogniser(std::span<const TaughtMove> taught, const SightWeights& weights,
                                                 const LearntModel& model);

}  // namespace etude
