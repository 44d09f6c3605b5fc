#pragma once

#include <string>
#include <vector>

#include "bench/statistics/select.h"

namespace etude {

/// The worlds in which a method met its strongest rival, of one metric.
struct RivalWorlds {
  std::string rival;  ///< "a", or "a or b" when the halves of the worlds chose differently; "" = there is none
  std::string note;   ///< how it was chosen, in words
  PairedWorlds worlds;
};

/// Whether a method competes: one that no method is compared with and that is compared with none is a yardstick, and
/// one with an oracle shows what could be.
bool Competes(const Study& study, const ComparedMethod& method);

/// `method` against the scenario's own rival, or against the best other one that competes: by the first headline
/// metric, of those that differ there by less than matters by the next one, and so on. It is chosen on other worlds
/// than those it is judged on: on the worlds of odd units (trials where worlds are units, or of several units) for
/// those of even ones, and the other way round. A cell that failed counts as the condition's worst value there. No
/// rival for the rival itself.
RivalWorlds FindRival(const Study& study, const ConditionTable& table, const std::string& method,
                      const std::string& metric);

}  // namespace etude
