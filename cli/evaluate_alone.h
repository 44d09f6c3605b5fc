#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "engine/base/result.h"

namespace etude {

/// The options of `etude evaluate --alone` that other evaluations do not have.
struct AloneOptions {
  bool is_alone = false;
  std::optional<double> floor_m;
  std::string limits;  ///< a file, or the name of a shipped file of limits; "" = no limits
};

/// Writes the text of a scenario that judges motions without a truth.
Result<std::string> ScenarioOfMotions(const std::vector<std::string>& files, const AloneOptions& options,
                                      const std::string& people);

/// The clips that a run judged without a truth, sorted by outcome.
struct Triage {
  std::size_t clips = 0, fault_free = 0;     ///< number of judged clips, and number of judged clips without a fault
  std::map<std::string, std::size_t> kinds;  ///< number of clips that show a fault, by the word for this kind of fault
  bool has_limits = false;
  // Lines have the form "METHOD, CLIP: why". A clip that exceeds its limits is in `beyond_limits` only; any other clip
  // with faults is in `faulty`.
  std::vector<std::string> faulty, beyond_limits, not_judged;
};
Triage TriageOf(const RunData& run);

/// Prints how many clips show each fault. Then names the clips that exceed their limits, the other faulty clips, and
/// the clips that could not be judged.
void PrintTriage(const Triage& triage);

}  // namespace etude
