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
  std::size_t clips = 0, fault_free = 0;     ///< judged; those without a fault
  std::map<std::string, std::size_t> kinds;  ///< by the word for a kind of fault, the clips that show it
  bool has_limits = false;
  // Lines: "METHOD, CLIP: why". A clip is either beyond its limits or, with faults, in `faulty`.
  std::vector<std::string> faulty, beyond_limits, not_judged;
};
Triage TriageOf(const RunData& run);

/// Prints how many clips show which faults, and names the clips that exceed their limits, those with other faults, and
/// those that could not be judged.
void PrintTriage(const Triage& triage);

}  // namespace etude
