#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bench/tasks/base/task.h"

namespace etude {

/// A swept parameter and its value in one condition, both as the scenario wrote them.
struct Setting {
  std::string key;
  std::string value;
  bool operator==(const Setting&) const = default;
};

/// One line of cells.jsonl: a cell's identity and what came of it.
struct Row {
  std::string scenario;
  std::string task;
  std::vector<Setting> condition;  ///< empty when nothing is swept
  int trial = 0;
  std::string clip;  ///< "" for tasks without clips
  std::string method;
  CellResult result;  ///< `series` and `recording` live in files of their own

  /// "scenario/key=value,key=value/trial/method", unique in a run; a condition without sweep is "-".
  std::string Id() const;
};

/// A row's value of a metric; nothing when it is missing or was not measured.
std::optional<double> ValueOf(const Row& row, std::string_view metric);

/// For people: "key=value, key=value", or "" when nothing is swept.
std::string ConditionLabel(const std::vector<Setting>& condition);
/// For identities: "key=value,key=value", or "-".
std::string CompactLabel(const std::vector<Setting>& condition);

/// How an interval was computed (bench/statistics/bootstrap.h, proportion.h).
enum class IntervalKind {
  kNone,
  kBca,           ///< bias-corrected and accelerated bootstrap
  kPercentile,    ///< bootstrap whose correction is undefined, e.g. of values that are all the same
  kWilson,        ///< score interval of a share
  kAdjustedWald,  ///< Bonett and Price's, of the difference of two shares on the same worlds
};
std::string_view IntervalKindName(IntervalKind kind);

/// One metric of one method over the trials of one condition.
struct MetricSummary {
  std::string id;
  int present = 0;
  int missing = 0;  ///< cells without a value, whatever the reason
  std::optional<double> median, mean;
  std::optional<double> ci_low, ci_high;  ///< 95 % interval of the metric's own aggregate (MetricInfo)
  IntervalKind interval = IntervalKind::kNone;
};

struct MethodSummary {
  std::string method;
  std::vector<std::pair<Status, int>> statuses;  ///< how many cells ended in each, zero ones left out
  std::vector<MetricSummary> metrics;
  int ok = 0;                             ///< cells of status ok …
  int attempted = 0;                      ///< … of all but the skipped ones: failures stay in the denominator
  std::optional<double> ok_low, ok_high;  ///< 95 % Wilson interval of ok / attempted
};

enum class Verdict { kBetter, kWorse, kNoDifference, kInconclusive };
std::string_view VerdictName(Verdict verdict);

/// A test of paired differences (bench/statistics/paired_tests.h).
struct PairedTest {
  std::optional<double> p;  ///< two-sided; nothing without pairs
  std::string how;          ///< "exact", "normal approximation", "9,999 draws"
};

/// `method` against `baseline` on the same worlds: the aggregate (MetricInfo: median, or mean for shares and
/// penalised costs) of the paired differences method − baseline.
struct Comparison {
  std::string metric;
  std::string baseline;
  std::string method;
  int pairs = 0;                                        ///< worlds in which both have a value
  int differing = 0;                                    ///< of the pairs, those whose values differ
  int only_baseline = 0, only_method = 0, neither = 0;  ///< worlds without a pair: who has a value there
  std::optional<double> difference, ci_low, ci_high;    ///< 95 % interval, pairs resampled
  IntervalKind interval = IntervalKind::kNone;
  std::optional<double> mean, mean_low, mean_high;  ///< of the same differences, whatever the metric's aggregate
  PairedTest signed_rank;                           ///< Wilcoxon's; decides where the aggregate is the median
  PairedTest sign_flip;                             ///< of the aggregate; decides where it is the mean
  std::optional<double> p_holm;       ///< the deciding p, corrected over the scenario's comparisons (Holm)
  double share_better = 0;            ///< of the pairs, ties count half
  std::optional<double> effect_size;  ///< rank-biserial correlation, −1…1; positive speaks for `method`, or, without
                                      ///< a direction, for larger values
  Verdict verdict = Verdict::kInconclusive;
  std::string why_open;            ///< when it is inconclusive: what is lacking, in words, if that can be named
  std::vector<std::string> notes;  ///< what else to know before believing the figures, in words
};

struct ConditionSummary {
  std::vector<Setting> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;  ///< every method against its baseline, headline metrics
};

enum class Outcome { kMet, kUnmet, kUndecided };
std::string_view OutcomeName(Outcome outcome);

/// What a scenario said it expects, and whether it came so.
struct ExpectationResult {
  std::string text;  ///< "orientation_error_deg of adaptive below fixed"
  Outcome outcome = Outcome::kUndecided;
  std::string detail;  ///< the figures that decided it
};

struct ScenarioSummary {
  std::string name;
  std::string task;
  std::string question;
  std::vector<std::string> methods;
  std::vector<std::string> headline_metrics;
  std::vector<ConditionSummary> conditions;
  std::vector<ExpectationResult> expectations;
  int family = 0;  ///< comparisons in all conditions and headline metrics, over which Holm's correction runs
};

struct CellSeries {
  std::string cell;  ///< Row::Id()
  std::vector<Series> series;
};

struct CellRecording {
  std::string cell;
  Recording recording;
};

/// A whole result folder in memory.
struct RunData {
  std::string suite;
  std::uint64_t seed = 1;
  std::string program_version;
  std::string command_line;  ///< from host.json
  std::string host;          ///< one line about the machine
  double wall_seconds = 0;
  std::vector<Row> rows;  ///< canonical order: scenario, condition, trial, method
  std::vector<ScenarioSummary> scenarios;
  std::vector<CellSeries> series;
  std::vector<CellRecording> recordings;
  std::map<std::string, double> cpu_seconds;  ///< processor time, by Row::Id(); empty where the folder tells of none
};

}  // namespace etude
