#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/statistics/curves/curves.h"

namespace etude {

/// A performance that a method judged.
struct JudgedPerformance {
  int person = 0;    ///< who performed it: the trial
  double score = 0;  ///< higher: looks righter
  double truth = 0;  ///< 1 right, ½ grey, 0 wrong
  bool is_called = false;
  double severity = 0;                    ///< of its worst fault; 0: none
  std::string fault = {};                 ///< that one's name; "" none
  std::string danced = {};                ///< the move truly danced; "" none
  std::optional<std::string> named = {};  ///< the move it was taken for, "" none; nothing where methods name no moves
};

/// The verdicts of one method on all performances under one condition.
struct MethodVerdicts {
  std::vector<JudgedPerformance> performances;
  std::vector<Wait> waits;  ///< of right performances, to be called right
};

/// Collects the verdicts under one condition by method, in the scenario's order, of those that judged something; cells'
/// series tell them (`performance_…`).
std::map<std::size_t, MethodVerdicts> VerdictsUnder(const RunData& run, const ScenarioSummary& scenario,
                                                    const ConditionSummary& condition);

}  // namespace etude
