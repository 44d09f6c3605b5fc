#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/base/settings.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {

struct RecogniserOptions;

/// A way to recognise moves, by the name scenario files call it.
struct RecogniserKind {
  std::string name;
  std::string description;       ///< one line, for people
  bool needs_key_poses = false;  ///< of every taught move
  bool needs_examples = false;   ///< at least one of every taught move
  /// The evidence from which on it calls a move right unless told otherwise, in (0, 1).
  double threshold = 0.5;
  /// The settings that `RecogniserOptions::settings` holds values for, in this order.
  std::vector<NumberSetting> settings = {};
  std::function<std::unique_ptr<Recogniser>(std::span<const TaughtMove> taught, const RecogniserOptions& options)>
      teach = {};
};

std::span<const RecogniserKind> AllRecognisers();
std::vector<std::string> RecogniserNames();
/// Returns the recogniser of that name, null when there is none.
const RecogniserKind* FindRecogniser(std::string_view name);

struct RecogniserOptions {
  const RecogniserKind* kind = &AllRecognisers().front();  ///< key-pose, paper A's
  SightWeights weights = {};
  std::vector<double> settings = {};  ///< one per setting of the kind, in their order; none at all: the defaults
};

/// A recogniser that was taught these moves; indices of moves are theirs. Refuses moves that lack what this kind needs,
/// two moves of one name, and key poses or spans out of their ranges.
///
///     ASSIGN_OR_RETURN(const auto recogniser, MakeRecogniser({.kind = FindRecogniser("dtw")}, taught));
///     const auto follower = recogniser->Follow(stream.rate_hz);
Result<std::unique_ptr<Recogniser>> MakeRecogniser(const RecogniserOptions& options,
                                                   std::span<const TaughtMove> taught);

}  // namespace etude
