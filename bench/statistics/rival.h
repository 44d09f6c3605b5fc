#pragma once

#include <array>
#include <optional>
#include <string>

#include "bench/statistics/select.h"

namespace etude {

/// A method's strongest rival.
struct Rival {
  std::array<std::string, 2> of_half;  ///< whom it meets in the worlds of even units, and in those of odd ones

  std::string Name() const;  ///< "a", or "a or b" when the halves of the worlds chose differently
  std::string Note() const;  ///< how they were chosen, in words; "" when both are the same
};

/// Whether a method competes: one that no method is compared with and that is compared with none is a yardstick, and
/// one with an oracle shows what could be.
bool Competes(const Study& study, const ComparedMethod& method);

/// The scenario's own rival, or the best other method that competes: by the first headline metric, of those that differ
/// there by less than matters by the next one, and so on. It is chosen on other worlds than those it is judged on: on
/// the worlds of odd units (trials where worlds are units, or of several units) for those of even ones, and the other
/// way round. A cell that failed counts as the condition's worst value there. No rival for the rival itself.
std::optional<Rival> FindRival(const Study& study, const ConditionTable& table, const std::string& method);

/// One metric of `method` and of whom it meets, in all worlds of the condition.
PairedWorlds WorldsAgainst(const Rival& rival, const ConditionTable& table, const std::string& method,
                           const std::string& metric);

}  // namespace etude
