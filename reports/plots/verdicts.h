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

struct JudgedPerformance {
  int person = 0;    ///< number of the trial, which identifies the person
  double score = 0;  ///< higher scores are nearer to right
  double truth = 0;  ///< 1 right, ½ grey, 0 wrong
  bool is_called = false;
  double severity = 0;      ///< severity of the worst fault, 0…1; 0 if there is none
  std::string fault = {};   ///< name of the worst fault; "" if there is none
  std::string danced = {};  ///< the move that was performed
  /// The move that the method recognised, "" for none; unset if the method names no moves.
  std::optional<std::string> named = {};
};

/// The verdicts of one method on all performances under one condition.
struct MethodVerdicts {
  std::vector<JudgedPerformance> performances;
  std::vector<Wait> waits;  ///< times from right performances until the method called them right
};

/// Returns the verdicts under one condition by method, in the scenario's order, without methods that judged nothing.
/// The verdicts come from the cells' series (`performance_…`).
std::map<std::size_t, MethodVerdicts> VerdictsUnder(const RunData& run, const ScenarioSummary& scenario,
                                                    const ConditionSummary& condition);

/// Counts performances by the danced move and the named move; "" stands for no move.
struct MoveConfusion {
  std::vector<std::string> moves;                             ///< danced or named; sorted
  std::map<std::pair<std::string, std::string>, int> counts;  ///< (danced, named)

  int Danced(const std::string& move) const;
};
MoveConfusion ConfusionOf(std::span<const JudgedPerformance> performances);

/// Counts the faulty performances, and how many of them were not called right.
struct FaultCount {
  int all = 0, found = 0;
};
/// Returns two counts for each name of a worst fault: one of performances with a slight fault (severity up to ½), one
/// of performances with a bad fault.
std::map<std::string, std::pair<FaultCount, FaultCount>> FoundByFault(std::span<const JudgedPerformance> performances);

/// The mistakes in a person's session: right performances that were missed, and wrong performances that were praised.
struct SessionMistakes {
  int person = 0, right = 0, missed = 0, wrong = 0, praised = 0;

  double Share() const { return static_cast<double>(missed + praised) / (right + wrong); }
};
/// Returns the sessions with mistakes; the session with the largest share of mistakes comes first.
std::vector<SessionMistakes> WorstSessions(std::span<const JudgedPerformance> performances);

/// Returns, per condition, tables of the faults found, of the worst sessions of the method in question, and of confused
/// moves. Returns "" if methods judge no performances.
std::string VerdictTablesHtml(const RunData& run, const ScenarioSummary& scenario);

/// Returns the share of faulty performances that were not called right, for each fifth of the severity range, as
/// (middle of the fifth, share). Fifths without performances are left out.
std::vector<std::pair<double, double>> FoundBySeverity(std::span<const JudgedPerformance> performances);

/// Returns the severity at which the share of found faults first rises through a half, by linear interpolation; nullopt
/// if it never does.
std::optional<double> HalfFoundAt(std::span<const std::pair<double, double>> curve);

/// Returns curves for a scenario's verdicts, per condition: every method's ROC curve with its area, its detection error
/// trade-off, the faults found by severity, and the waits for praise. Returns "" if methods judge no performances.
std::string VerdictCurvesHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
