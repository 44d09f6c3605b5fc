#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cli/clip_commands.h"

namespace etude {

struct TrainOptions {
  std::vector<std::string> clips;
  std::string output;              ///< a fuzzy system file
  std::string method = "genetic";  ///< or "adaptive"
  bool memberships = false;        ///< tune the membership functions, too
  std::uint64_t seed = 1;
  int population = 40, generations = 60;
  bool recogniser = false;       ///< learn the recogniser `learnt` instead, from simulated people who dance the clips
  bool coached = false;          ///< learn the recogniser `coached` instead; `clips` are songs
  std::optional<int> sessions;   ///< of those people, with `recogniser` or `coached`; else as many as the built-in had
  std::string hold_out = "0.3";  ///< a share of the clips, or a pattern of their names
  bool overwrite = false;
  ClipReading reading;
};
/// `etude train`: learns a fuzzy system from clips, writes its file, and prints what it knows of clips held out.
int TrainCommand(const TrainOptions& options);
/// The same with `recogniser` or `coached`: writes a model file as scenarios/recognisers/learnt.yaml is one.
int TrainRecogniserCommand(const TrainOptions& options);

}  // namespace etude
