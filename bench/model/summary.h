#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/unit.h"

namespace etude {

/// The method by which an interval was computed (bench/statistics/bootstrap.h, interval.h).
enum class IntervalKind {
  kNone,
  kBca,              ///< bias-corrected and accelerated bootstrap
  kPercentile,       ///< percentile bootstrap, where the BCa correction is undefined, e.g. all values equal
  kWilson,           ///< score interval of a share
  kAdjustedWald,     ///< Bonett and Price's, of the difference of two shares on the same worlds
  kStudent,          ///< Student's t: of a mean over units, or over very many worlds
  kOrderStatistics,  ///< order statistics: of the median of very many worlds
};
inline constexpr std::array<Named<IntervalKind>, 7> kIntervalKinds = {
    {{"none", IntervalKind::kNone},
     {"bca", IntervalKind::kBca},
     {"percentile", IntervalKind::kPercentile},
     {"wilson", IntervalKind::kWilson},
     {"adjusted wald", IntervalKind::kAdjustedWald},
     {"student", IntervalKind::kStudent},
     {"order statistics", IntervalKind::kOrderStatistics}}};
std::string_view IntervalKindName(IntervalKind kind);

/// One metric of one method over the trials of one condition.
struct MetricSummary {
  std::string id;
  int present = 0;
  int missing = 0;  ///< cells without a value, for any reason
  std::optional<double> median, mean;
  std::optional<double> ci_low, ci_high;  ///< 95 % interval of the metric's own aggregate (MetricInfo)
  IntervalKind interval = IntervalKind::kNone;
};

struct MethodSummary {
  std::string method;
  std::vector<std::pair<Status, int>> statuses;  ///< number of cells that ended in each status; zeros are left out
  std::vector<MetricSummary> metrics;
  int ok = 0;                             ///< cells of status ok
  int attempted = 0;                      ///< all cells but skipped ones; failures stay in the denominator
  std::optional<double> ok_low, ok_high;  ///< 95 % Wilson interval of ok / attempted
};

enum class Verdict { kBetter, kWorse, kNoDifference, kInconclusive };
inline constexpr std::array<Named<Verdict>, 4> kVerdicts = {{{"better", Verdict::kBetter},
                                                             {"worse", Verdict::kWorse},
                                                             {"no difference", Verdict::kNoDifference},
                                                             {"inconclusive", Verdict::kInconclusive}}};
std::string_view VerdictName(Verdict verdict);

/// A test of paired differences (bench/statistics/paired_tests.h).
struct PairedTest {
  std::optional<double> p;  ///< two-sided; nothing without pairs
  std::string how;          ///< "exact", "normal approximation", "9,999 draws"
};

/// A comparison's mean difference if the worlds of one unit are left out.
struct LeftOut {
  std::string unit;
  double difference = 0;
};

/// The result of a comparison for other units (clips, people, …) like those that its worlds were drawn from
/// (bench/statistics/beyond.h). If every world is its own unit, it equals the result on the worlds.
struct Beyond {
  int units = 0;                                ///< units that have a pair
  int differing = 0;                            ///< units whose mean difference is not zero
  std::optional<double> difference, low, high;  ///< pseudo-median of the units' mean differences, which the verdict is
                                                ///< about, and its 95 % interval
  std::optional<double> mean, mean_low, mean_high;  ///< their mean and its 95 % interval
  PairedTest test;                                  ///< the test that decides
  std::optional<double> p_holm;                     ///< corrected over the scenario's comparisons (Holm)
  std::optional<Verdict> verdict;                   ///< nothing = too few units for a verdict
  std::string why_open;                             ///< says why there is no verdict, or an inconclusive one
  std::vector<LeftOut> left_out;                    ///< in the order of the units' names; empty if worlds are the units
};

/// `method` against `baseline` on the same worlds: the aggregate (MetricInfo: median, or mean for shares and
/// penalised costs) of the paired differences method − baseline.
struct Comparison {
  std::string metric;
  std::string baseline;
  std::string method;
  int pairs = 0;                                        ///< worlds in which both have a value
  int differing = 0;                                    ///< pairs whose values differ
  int only_baseline = 0, only_method = 0, neither = 0;  ///< worlds without a pair, by which method has a value
  std::optional<double> difference, ci_low, ci_high;    ///< 95 % interval, pairs resampled
  IntervalKind interval = IntervalKind::kNone;
  std::optional<double> mean, mean_low, mean_high;  ///< mean of the same differences and its 95 % interval, for every
                                                    ///< metric
  PairedTest signed_rank;                           ///< Wilcoxon's; decides if the aggregate is the median
  PairedTest sign_flip;                             ///< of the aggregate; decides if it is the mean
  std::optional<double> p_holm;       ///< the deciding p, corrected over the scenario's comparisons (Holm)
  int better = 0, worse = 0;          ///< pairs in which the method is better, or worse, by at least what matters
  double share_better = 0;            ///< share of the pairs in which the method is better; ties count half
  std::optional<double> effect_size;  ///< rank-biserial correlation, −1…1; positive favours `method`, or, without a
                                      ///< direction, larger values
  Verdict verdict = Verdict::kInconclusive;  ///< on these worlds
  std::string why_open;                      ///< says why the verdict is inconclusive, if a reason is known
  std::vector<std::string> notes;            ///< what else a reader should know before trusting the figures
  Beyond beyond;                             ///< the same comparison for other units like these
};

/// The step of an answer that decided it: success first, then the value, then the tail.
enum class AnswerStep { kNone, kSuccess, kValue, kTail };
inline constexpr std::array<Named<AnswerStep>, 4> kAnswerSteps = {{{"none", AnswerStep::kNone},
                                                                   {"success", AnswerStep::kSuccess},
                                                                   {"value", AnswerStep::kValue},
                                                                   {"tail", AnswerStep::kTail}}};

/// How a method did against another under one condition, in one verdict (bench/statistics/answers.h). Every reader of a
/// run speaks of this one.
struct Answer {
  std::string method;
  std::string baseline = {};                 ///< the method that the scenario names, or the strongest rival
  std::string value_metric = {};             ///< ValueMetricOf; "" if success is all
  Verdict verdict = Verdict::kInconclusive;  ///< on these worlds
  AnswerStep decided_by = AnswerStep::kNone;
  std::optional<Verdict> beyond = {};      ///< the deciding step's verdict for other units; nothing = too few units
  std::optional<Comparison> success = {};  ///< of the task's success, failed cells as 0; nothing if no cell says it
  std::optional<Comparison> both_succeed = {};  ///< of the value where both succeeded; nothing if that is every world,
                                                ///< or none, or success is no yes or no
  std::optional<Comparison> tail = {};          ///< share of worlds far better − share of worlds far worse
};

/// The cost of one stage: how much smaller the error is if the truth replaces the stage, mean over worlds.
struct BudgetShare {
  std::string stage;  ///< or several stages that were replaced together
  double mean = 0;
  std::optional<double> ci_low = {}, ci_high = {};  ///< 95 % interval of the mean
};

/// The error of one method, split into the costs of its stages (bench/statistics/summary.h).
struct ErrorBudget {
  std::string metric;
  std::string method;       ///< the method with no stage, or the fewest, replaced by the truth
  bool is_shapley = false;  ///< true: shares are averages over all orders; false: those of one order, that of `shares`
  int worlds = 0;
  double total = 0, rest = 0;  ///< mean error of that method, and of the method with the most stages replaced
  std::vector<BudgetShare> shares;
};

struct ConditionSummary {
  std::vector<SweptValue> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;     ///< every method with its baseline, on the headline metrics
  std::vector<Comparison> rivals;          ///< every method with the strongest other one, on the headline metrics
  std::vector<Answer> answers = {};        ///< every method with its baseline
  std::vector<Answer> rival_answers = {};  ///< every method with the strongest other one
  std::vector<ErrorBudget> budgets = {};   ///< of the first headline metric, for methods that differ in oracles alone
};

/// One comparison under every value of the parameters across which a verdict must hold (`across`). If a parameter of
/// our own simulation, such as how people learn, changes the verdict, the verdict says nothing about the methods.
struct AcrossVerdict {
  std::vector<SweptValue> condition;  ///< the values of the other swept parameters
  std::string metric;
  std::string baseline;
  std::string method;
  struct Each {
    std::string value;  ///< "learning=power"
    Verdict verdict = Verdict::kInconclusive;
    std::optional<double> difference;
  };
  std::vector<Each> each;
  Verdict verdict = Verdict::kInconclusive;  ///< the verdict under all values, or inconclusive if they differ

  bool Holds() const { return verdict != Verdict::kInconclusive; }
};

/// The result of judging a claim: an expectation or a time rule.
enum class ClaimOutcome { kMet, kUnmet, kUndecided };
inline constexpr std::array<Named<ClaimOutcome>, 3> kClaimOutcomes = {
    {{"met", ClaimOutcome::kMet}, {"unmet", ClaimOutcome::kUnmet}, {"undecided", ClaimOutcome::kUndecided}}};
std::string_view ClaimOutcomeName(ClaimOutcome ruling);

/// An expectation of a scenario and its result.
struct ExpectationResult {
  std::string text;  ///< "orientation_error_deg of adaptive below fixed"
  ClaimOutcome ruling = ClaimOutcome::kUndecided;
  std::string detail;  ///< the figures that decided it
};

struct ScenarioSummary {
  std::string name;
  std::string task;
  std::string question;
  SamplingUnit unit = SamplingUnit::kWorld;
  std::vector<std::string> methods;
  std::vector<std::string> headline_metrics;
  std::vector<ConditionSummary> conditions;
  std::vector<ExpectationResult> expectations;
  int family = 0;  ///< number of comparisons over all conditions and headline metrics, among which Holm's correction
                   ///< runs
  std::vector<AcrossVerdict> across = {};      ///< empty if no verdict must hold across parameters
  std::string description = {};                ///< what its worlds are, in a sentence; "" = not described
  std::vector<std::string> descriptions = {};  ///< what each method is, in a sentence; empty if no method is described
};

}  // namespace etude
