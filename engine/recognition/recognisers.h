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

/// A kind of recogniser, with the name that scenario files use.
struct RecogniserKind {
  std::string name;
  std::string description;       ///< one line for users
  bool needs_key_poses = false;  ///< true if every taught move must have key poses
  bool needs_examples = false;   ///< true if every taught move must have at least one example
  /// The default evidence at which this recogniser calls a move right, in (0, 1).
  double threshold = 0.5;
  /// The settings of this recogniser, in the order of the values in `RecogniserOptions::settings`.
  std::vector<NumberSetting> settings = {};
  std::function<std::unique_ptr<Recogniser>(std::span<const TaughtMove> taught, const RecogniserOptions& options)>
      teach = {};
};

std::span<const RecogniserKind> AllRecognisers();
std::vector<std::string> RecogniserNames();
/// Returns the recogniser called `name`, or null if there is none.
const RecogniserKind* FindRecogniser(std::string_view name);

/// Returns the recogniser recommended for these moves (docs/detection.md): `key-pose` if a move has no example that
/// shows a body; otherwise `whole-body` if every move has at least three examples, else `learnt`. If `by_a_coach` is
/// true, `coached` replaces the last two, because a coach asks for moves in time with music.
const RecogniserKind& RecommendedRecogniser(std::span<const TaughtMove> taught, bool by_a_coach = false);

struct RecogniserOptions {
  const RecogniserKind* kind = &AllRecognisers().front();  ///< default: key-pose, paper A's recogniser
  TrackingWeights weights = {};
  std::vector<double> settings = {};  ///< one value per setting of the kind, in order; if empty, the defaults apply
};

/// Makes a recogniser for these moves. It identifies a move by its index in `taught`. Returns an error if a move lacks
/// what this kind needs, if two moves have the same name, or if a key pose or span is out of range.
///
///     ASSIGN_OR_RETURN(const auto recogniser, MakeRecogniser({.kind = FindRecogniser("dtw")}, taught));
///     const auto follower = recogniser->Follow(stream.rate_hz);
Result<std::unique_ptr<Recogniser>> MakeRecogniser(const RecogniserOptions& options,
                                                   std::span<const TaughtMove> taught);

}  // namespace etude
