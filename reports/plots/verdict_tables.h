#pragma once

#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "reports/plots/judged_performances.h"

namespace etude {

/// Counts how often each move danced was taken for which, "" for none.
struct MoveConfusion {
  std::vector<std::string> moves;                             ///< danced or named, sorted
  std::map<std::pair<std::string, std::string>, int> counts;  ///< (danced, named)

  int Danced(const std::string& move) const;
};
MoveConfusion ConfusionOf(std::span<const JudgedPerformance> performances);

/// Counts faulty performances, and those of them that were not called right.
struct FaultCount {
  int all = 0, found = 0;
};
/// Counts by the worst fault's name: slight ones (severity to ½), and bad ones.
std::map<std::string, std::pair<FaultCount, FaultCount>> FoundByFault(std::span<const JudgedPerformance> performances);

/// A person's session, by its mistakes: right performances not called so, wrong ones called right.
struct SessionMistakes {
  int person = 0, right = 0, missed = 0, wrong = 0, praised = 0;

  double Share() const { return static_cast<double>(missed + praised) / (right + wrong); }
};
/// Gives the sessions with the worst first, by the share of mistakes; those without a mistake, and those without
/// performances that are right or wrong, are left out.
std::vector<SessionMistakes> WorstSessions(std::span<const JudgedPerformance> performances);

/// Writes per condition which faults are found, the worst sessions of the method in question, and what moves are taken
/// for. "" where methods judge no performances.
std::string VerdictTablesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
