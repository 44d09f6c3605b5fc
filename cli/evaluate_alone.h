#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/base/result.h"

namespace etude {

/// The options of `etude evaluate --alone` beside those of every evaluation.
struct AloneOptions {
  bool is_alone = false;
  std::optional<double> floor_m;
  std::string limits;  ///< a file, or the name of one that comes with etude; "" = none
};

/// Writes the scenario of motions without a truth.
Result<std::string> ScenarioOfMotions(const std::vector<std::string>& files, const AloneOptions& options,
                                      const std::string& people);

/// The clips of a run of motions without a truth.
struct Triage {
  std::size_t clips = 0;                     ///< number of clips that were judged
  std::map<std::string, std::size_t> kinds;  ///< number of clips that show each kind of fault, by its word
  bool has_limits = false;
  // Lines: "METHOD, CLIP: why".
  std::vector<std::string> faulty, beyond_limits, not_judged;
};
Triage TriageOf(const RunData& run);

/// Prints the number of clips with each kind of fault. With limits it names the clips that exceed them; without, all
/// clips that show a fault.
void PrintTriage(const Triage& triage);

}  // namespace etude
