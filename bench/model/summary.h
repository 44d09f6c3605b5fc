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
  kAdjustedWald,     ///< Bonett and Price's interval of the difference of two shares on the same worlds
  kStudent,          ///< Student's t interval of a mean over units, or over very many worlds
  kOrderStatistics,  ///< interval of the median of very many worlds, from order statistics
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

/// The values of one metric of one method over the trials of one condition, summarised.
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
  int attempted = 0;                      ///< all cells except skipped ones; failures count as attempts
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
  std::optional<double> p;  ///< two-sided; nothing if there are no pairs
  std::string how;          ///< "exact", "normal approximation", "9,999 draws"
};

/// The mean difference of a comparison if the worlds of one unit are left out.
struct LeftOut {
  std::string unit;
  double difference = 0;
};

/// The result of a comparison, generalised from the units of its worlds (clips, people, …) to other units like them
/// (bench/statistics/beyond.h). If every world is its own unit, the result equals the result on the worlds.
struct Beyond {
  int units = 0;      ///< units that have a pair
  int differing = 0;  ///< units whose mean difference is not zero
  /// The pseudo-median of the units' mean differences, and its 95 % interval. The verdict is judged from this interval.
  std::optional<double> difference, low, high;
  std::optional<double> mean, mean_low, mean_high;  ///< the mean of the units' means, and its 95 % interval
  PairedTest test;                                  ///< the test that decides the verdict
  std::optional<double> p_holm;                     ///< p after Holm's correction over the scenario's comparisons
  std::optional<Verdict> verdict;                   ///< nothing = too few units for a verdict
  std::string why_open;                             ///< why there is no verdict or an inconclusive one
  std::vector<LeftOut> left_out;                    ///< in the order of the units' names; empty if worlds are the units
};

/// The comparison of `method` with `baseline` on the same worlds: the median of the paired differences method −
/// baseline. For shares and penalised costs it is the mean (MetricInfo).
struct Comparison {
  std::string metric;
  std::string baseline;
  std::string method;
  int pairs = 0;      ///< worlds in which both have a value
  int differing = 0;  ///< pairs whose values differ
  /// Worlds without a pair: only the baseline has a value, only the method has one, or neither has one.
  int only_baseline = 0, only_method = 0, neither = 0;
  std::optional<double> difference, ci_low, ci_high;  ///< the aggregate of the differences and its 95 % interval
  IntervalKind interval = IntervalKind::kNone;
  /// The mean of the paired differences and its 95 % interval. It is computed for every metric.
  std::optional<double> mean, mean_low, mean_high;
  PairedTest signed_rank;        ///< Wilcoxon's test; it decides if the aggregate is the median
  PairedTest sign_flip;          ///< the sign-flip test; it decides if the aggregate is the mean
  std::optional<double> p_holm;  ///< the deciding p, corrected over the scenario's comparisons (Holm)
  /// The numbers of pairs in which the method is better, or worse, by at least the practical threshold.
  int better = 0, worse = 0;
  double share_better = 0;  ///< share of the pairs in which the method is better; ties count half
  /// Rank-biserial correlation, −1…1. It is positive if `method` is better or, for a metric without a direction, if its
  /// values are larger.
  std::optional<double> effect_size;
  Verdict verdict = Verdict::kInconclusive;  ///< the verdict on these worlds
  std::string why_open;                      ///< why the verdict is inconclusive, if a reason is known
  std::vector<std::string> notes;            ///< further warnings for readers of the figures
  Beyond beyond;                             ///< the result for other units like the sampled ones
};

/// The step that decided an answer. Success is compared first, then the value, then the tail.
enum class AnswerStep { kNone, kSuccess, kValue, kTail };
inline constexpr std::array<Named<AnswerStep>, 4> kAnswerSteps = {{{"none", AnswerStep::kNone},
                                                                   {"success", AnswerStep::kSuccess},
                                                                   {"value", AnswerStep::kValue},
                                                                   {"tail", AnswerStep::kTail}}};

/// The verdict on whether a method is better than another under one condition (bench/statistics/answers.h). Every page,
/// table and program that shows a run uses this verdict.
struct Answer {
  std::string method;
  std::string baseline = {};      ///< the method that the scenario names, or the strongest rival
  std::string value_metric = {};  ///< ValueMetricOf; "" if the scenario has only its success
  Verdict verdict = Verdict::kInconclusive;  ///< the verdict on these worlds
  AnswerStep decided_by = AnswerStep::kNone;
  std::optional<Verdict> beyond = {};  ///< the deciding step's verdict for other units; nothing = too few units
  /// The comparison of `Study::success`, in which failed cells count 0; nullopt if no cell has a value.
  std::optional<Comparison> success = {};
  /// The comparison of the value in the worlds in which both methods succeeded. Nullopt if both succeeded in all worlds
  /// or in none, or if success is not a yes or no.
  std::optional<Comparison> both_succeed = {};
  /// The share of worlds in which the method is far better, minus the share in which it is far worse.
  std::optional<Comparison> tail = {};
};

/// The cost of one stage: the mean reduction of the error, over worlds, when the truth replaces the stage.
struct BudgetShare {
  std::string stage;  ///< one stage, or several that were replaced together
  double mean = 0;
  std::optional<double> ci_low = {}, ci_high = {};  ///< 95 % interval of the mean
};

/// The error of one method, split into the costs of its stages (bench/statistics/summary.h).
struct ErrorBudget {
  std::string metric;
  std::string method;       ///< the method with no stage replaced by the truth, or with the fewest
  bool is_shapley = false;  ///< true: shares are means over all orders of the stages; false: `shares` follow one order
  int worlds = 0;
  double total = 0, rest = 0;  ///< mean error of `method`, and of the method with the most replaced stages
  std::vector<BudgetShare> shares;
};

struct ConditionSummary {
  std::vector<SweptValue> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;     ///< every method against its baseline, on the headline metrics
  std::vector<Comparison> rivals;          ///< every method against the strongest other one, on the headline metrics
  std::vector<Answer> answers = {};        ///< every method against its baseline
  std::vector<Answer> rival_answers = {};  ///< every method against the strongest other one
  /// Error budgets of the first headline metric, for methods that differ only in their oracles.
  std::vector<ErrorBudget> budgets = {};
};

/// The verdict of one comparison under every value of the parameters that `across` names. If the verdict depends on a
/// parameter of the simulation itself, e.g. the law of learning, it says nothing about the methods.
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
std::string_view ClaimOutcomeName(ClaimOutcome outcome);

/// An expectation of a scenario and its result.
struct ExpectationResult {
  std::string text;  ///< "orientation_error_deg of adaptive below fixed"
  ClaimOutcome outcome = ClaimOutcome::kUndecided;
  std::string detail;  ///< the figures that decided the outcome
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
  int family = 0;  ///< number of comparisons over all conditions and headline metrics that Holm's correction covers
  std::vector<AcrossVerdict> across = {};      ///< empty if no verdict must hold across parameters
  std::string description = {};                ///< a sentence about its worlds; "" = not described
  std::vector<std::string> descriptions = {};  ///< a sentence about each method; empty if no method is described
};

}  // namespace etude
