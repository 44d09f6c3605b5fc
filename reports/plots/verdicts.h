#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
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

/// The share of faulty performances not called right by severity, in fifths: (middle, share), those without any left
/// out.
std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances);

/// The least severity from which on half of the faults are found, on straight lines between the points; nothing when
/// the curve does not rise through a half.
std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve);

/// A scenario's verdicts as curves, per condition: ROC of every method with its area, the same as a detection error
/// trade-off, faults found by severity, waits for praise. "" where methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
