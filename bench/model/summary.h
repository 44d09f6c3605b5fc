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
  kPercentile,       ///< percentile bootstrap; used if the BCa correction is undefined, e.g. if all values are equal
  kWilson,           ///< Wilson's score interval of a share
  kAdjustedWald,     ///< Bonett and Price's adjusted Wald interval of the difference of two shares on the same worlds
  kStudent,          ///< Student's t interval of a mean over sampling units, or over very many worlds
  kOrderStatistics,  ///< order-statistics interval of the median of very many worlds
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

/// The summary of one metric's values for one method, over the trials of one condition.
struct MetricSummary {
  std::string id;
  int present = 0;
  int missing = 0;  ///< number of cells without a value, for any reason
  std::optional<double> median, mean;
  /// 95 % confidence interval of the median or mean that the metric defines as its aggregate (MetricInfo)
  std::optional<double> ci_low, ci_high;
  IntervalKind interval = IntervalKind::kNone;
};

struct MethodSummary {
  std::string method;
  std::vector<std::pair<Status, int>> statuses;  ///< number of cells that ended in each status; zeros are left out
  std::vector<MetricSummary> metrics;
  int ok = 0;                             ///< number of cells with status ok
  int attempted = 0;                      ///< number of cells that were not skipped, including failed cells
  std::optional<double> ok_low, ok_high;  ///< 95 % Wilson interval of ok / attempted
};

enum class Verdict { kBetter, kWorse, kNoDifference, kUndecided };
inline constexpr std::array<Named<Verdict>, 4> kVerdicts = {{{"better", Verdict::kBetter},
                                                             {"worse", Verdict::kWorse},
                                                             {"no difference", Verdict::kNoDifference},
                                                             {"undecided", Verdict::kUndecided}}};
std::string_view VerdictName(Verdict verdict);

/// A test of paired differences (bench/statistics/paired_tests.h).
struct PairedTest {
  std::optional<double> p;  ///< two-sided p-value; nullopt if there are no pairs
  std::string how;          ///< how p was computed, e.g. "exact", "normal approximation", "9,999 draws"
};

/// The mean difference of a comparison when the worlds of one sampling unit (clip, person, …) are left out.
struct LeftOut {
  std::string unit;
  double difference = 0;
};

/// The result of a comparison, generalised from the sampling units of this run (clips, people, …) to units that were
/// not run (bench/statistics/beyond.h). If every world is its own unit, the result equals the result on the worlds.
struct Beyond {
  int units = 0;      ///< number of sampling units with at least one pair (a world with values of both methods)
  int differing = 0;  ///< number of units whose mean difference is not zero
  /// The pseudo-median (Hodges–Lehmann) of the units' mean differences, and its 95 % interval, which decides the
  /// verdict.
  std::optional<double> difference, low, high;
  std::optional<double> mean, mean_low, mean_high;  ///< the mean of the units' mean differences, and its 95 % interval
  PairedTest test;                 ///< the test of the units' mean differences that decides the verdict
  std::optional<double> p_holm;    ///< p-value of `test` after Holm's correction over the scenario's comparisons
  std::optional<Verdict> verdict;  ///< verdict for units that were not run; nullopt = too few units in this run
  std::string why_open;            ///< why there is no verdict, or why the verdict is undecided
  std::string not_alike;           ///< as in Comparison
  std::vector<LeftOut> left_out;   ///< one entry per unit, in the order of names; empty if every world is its own unit
};

/// The comparison of `method` with `baseline` on the same worlds. It aggregates the paired differences method −
/// baseline: by their median, or for shares and penalised costs by their mean (MetricInfo).
struct Comparison {
  std::string metric;
  std::string baseline;
  std::string method;
  int pairs = 0;      ///< number of pairs: worlds in which both methods have a value
  int differing = 0;  ///< number of pairs whose two values differ
  /// Numbers of worlds without a pair: only the baseline has a value, only the method has one, or neither has one.
  int only_baseline = 0, only_method = 0, neither = 0;
  /// The median or mean of the paired differences, and its 95 % interval.
  std::optional<double> difference, ci_low, ci_high;
  IntervalKind interval = IntervalKind::kNone;
  /// The mean of the paired differences and its 95 % interval. It is computed for every metric.
  std::optional<double> mean, mean_low, mean_high;
  PairedTest signed_rank;  ///< Wilcoxon's signed-rank test; it decides the verdict if `difference` is a median
  PairedTest sign_flip;    ///< the sign-flip (permutation) test; it decides the verdict if `difference` is a mean
  /// p-value of the test that decides the verdict, after Holm's correction over the scenario's comparisons.
  std::optional<double> p_holm;
  /// The numbers of pairs in which the method is better, or worse, by at least the practical threshold.
  int better = 0, worse = 0;
  double share_better = 0;  ///< share of the pairs in which the method is better; ties count half
  /// Rank-biserial correlation, −1…1. It is positive if `method` is better or, for a metric without a direction, if the
  /// method's values are larger.
  std::optional<double> effect_size;
  Verdict verdict = Verdict::kUndecided;     ///< the verdict on the worlds of this run
  std::string why_open;                      ///< why the verdict is undecided, if a reason is known
  std::string not_alike;                     ///< why no verdict is possible: WhyNotAlike; "" = both were judged alike
  std::vector<std::string> notes;            ///< warnings for readers of the numbers
  Beyond beyond;                             ///< the result generalised to sampling units that were not run
};

/// The comparison that decided an answer. Success is compared first, then the value metric, then the tail: the far
/// better and far worse worlds.
enum class AnswerStep { kNone, kSuccess, kValue, kTail };
inline constexpr std::array<Named<AnswerStep>, 4> kAnswerSteps = {{{"none", AnswerStep::kNone},
                                                                   {"success", AnswerStep::kSuccess},
                                                                   {"value", AnswerStep::kValue},
                                                                   {"tail", AnswerStep::kTail}}};

/// The verdict on whether a method is better than another under one condition (bench/statistics/answers.h). Every page,
/// table and program that shows a run uses this verdict.
struct Answer {
  std::string method;
  /// The other method of the comparison: the scenario's baseline, or the strongest other method.
  std::string baseline = {};
  std::string value_metric = {};             ///< the metric that ValueMetricOf returns; "" if there is none
  Verdict verdict = Verdict::kUndecided;     ///< the verdict on the worlds of this run
  AnswerStep decided_by = AnswerStep::kNone;
  /// The verdict of the comparison that decided, generalised to other sampling units; nullopt = too few units.
  std::optional<Verdict> beyond = {};
  /// The comparison of the success metric (Study::success), in which failed cells count 0; nullopt if no cell has a
  /// value.
  std::optional<Comparison> success = {};
  /// The comparison of the value metric in the worlds where both methods succeeded. It is nullopt if both succeeded in
  /// all worlds or in none, or if success is not a yes-or-no value.
  std::optional<Comparison> both_succeed = {};
  /// The comparison of the tails: the share of worlds in which the method is far better, minus the share in which it is
  /// far worse.
  std::optional<Comparison> tail = {};
};

/// The cost of one processing stage: the mean reduction of the error, over worlds, when ground truth replaces the
/// stage.
struct BudgetShare {
  std::string stage;  ///< the processing stage, or several stages that were replaced together
  double mean = 0;
  std::optional<double> ci_low = {}, ci_high = {};  ///< 95 % interval of the mean reduction
};

/// The error of one method, split into the costs of its processing stages (bench/statistics/summary.h).
struct ErrorBudget {
  std::string metric;
  std::string method;  ///< the method in which ground truth replaces no stage, or the fewest stages
  /// True: each cost is a mean over all orders in which the stages can be replaced (Shapley value); false: the costs
  /// follow one order.
  bool is_shapley = false;
  int worlds = 0;
  /// Mean error of `method`, and of the method in which ground truth replaces the most stages.
  double total = 0, rest = 0;
  std::vector<BudgetShare> shares;
};

struct ConditionSummary {
  std::vector<SweptValue> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;  ///< comparisons of every method with its baseline, for each headline metric
  /// Comparisons of every method with the strongest other method, for each headline metric.
  std::vector<Comparison> rivals;
  std::vector<Answer> answers = {};        ///< answers about every method against its baseline
  std::vector<Answer> rival_answers = {};  ///< answers about every method against the strongest other method
  /// Error budgets of the first headline metric, for methods that differ only in the stages that ground truth replaces.
  std::vector<ErrorBudget> budgets = {};
};

/// The verdict of one comparison under every value of the parameters that `across` names. If the verdict depends on a
/// parameter of the simulation itself, e.g. the law of learning, the verdict says nothing about the methods.
struct AcrossVerdict {
  std::vector<SweptValue> condition;  ///< the values of the swept parameters that `across` does not name
  std::string metric;
  std::string baseline;
  std::string method;
  struct Each {
    std::string value;  ///< the values of the parameters that `across` names, e.g. "learning=power"
    Verdict verdict = Verdict::kUndecided;
    std::optional<double> difference;
  };
  std::vector<Each> each;
  Verdict verdict = Verdict::kUndecided;  ///< the verdict if it is the same under all values, else undecided

  bool Holds() const { return verdict != Verdict::kUndecided; }
};

/// The result of judging a claim: an expectation or a time rule.
enum class ClaimOutcome { kMet, kUnmet, kUndecided };
inline constexpr std::array<Named<ClaimOutcome>, 3> kClaimOutcomes = {
    {{"met", ClaimOutcome::kMet}, {"unmet", ClaimOutcome::kUnmet}, {"undecided", ClaimOutcome::kUndecided}}};
std::string_view ClaimOutcomeName(ClaimOutcome outcome);

/// An expectation of a scenario and its result.
struct ExpectationResult {
  std::string text;  ///< the claim, e.g. "orientation_error_deg of adaptive below fixed"
  ClaimOutcome outcome = ClaimOutcome::kUndecided;
  std::string detail;  ///< the numbers that decided the outcome
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
  /// Number of comparisons, over all conditions and headline metrics, to which Holm's correction applies together.
  int family = 0;
  std::vector<AcrossVerdict> across = {};  ///< verdicts under all values of the parameters in `across`; empty without
                                           ///< this key
  std::string description = {};            ///< a sentence about the scenario's worlds; "" = not described
  /// One sentence about each method; empty if the scenario describes no method.
  std::vector<std::string> descriptions = {};
};

}  // namespace etude
