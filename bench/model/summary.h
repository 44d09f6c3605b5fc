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
  kPercentile,       ///< bootstrap whose correction is undefined, e.g. of values that are all the same
  kWilson,           ///< score interval of a share
  kAdjustedWald,     ///< Bonett and Price's, of the difference of two shares on the same worlds
  kStudent,          ///< Student's t, of a mean over units or over very many worlds
  kOrderStatistics,  ///< of the median of very many worlds
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

/// A comparison's mean difference without the worlds of one unit.
struct LeftOut {
  std::string unit;
  double difference = 0;
};

/// The result of a comparison beyond its worlds: about other units (clips, people, …) like those it was sampled from
/// (bench/statistics/beyond.h). Where every world is its own unit this says what the worlds say.
struct Beyond {
  int units = 0;                                  ///< that have a pair
  int differing = 0;                              ///< of these, whose mean difference is not zero
  std::optional<double> difference, low, high;    ///< mean over units of their mean difference; 95 % interval
  std::optional<double> median_low, median_high;  ///< 95 % interval of the median of the units' mean differences
  PairedTest test;                                ///< that decides
  std::optional<double> p_holm;                   ///< corrected over the scenario's comparisons (Holm)
  std::optional<Verdict> verdict;                 ///< nothing = there are too few units for any
  std::string why_open;                           ///< why there is no verdict, or it is inconclusive, in words
  std::vector<LeftOut> left_out;                  ///< in the order of the units' names; empty where worlds are units
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
  Verdict verdict = Verdict::kInconclusive;  ///< on these worlds
  std::string why_open;            ///< when it is inconclusive: what is lacking, in words, if that can be named
  std::vector<std::string> notes;  ///< what else to know before believing the figures, in words
  Beyond beyond;                   ///< these worlds, for other units like theirs
};

/// The cost of one stage: how much smaller the error is when the truth stands for it, mean over worlds.
struct BudgetShare {
  std::string stage;  ///< or several, that were made true together
  double mean = 0;
  std::optional<double> ci_low = {}, ci_high = {};  ///< 95 % interval of the mean
};

/// The error of one method, split into what its stages cost (bench/statistics/summary.h).
struct ErrorBudget {
  std::string metric;
  std::string method;       ///< of which no stage, or the fewest, is true
  bool is_shapley = false;  ///< shares are averages over all orders; else those of one order, that of `shares`
  int worlds = 0;
  double total = 0, rest = 0;  ///< mean error of that method, and of the one with the most stages true
  std::vector<BudgetShare> shares;
};

struct ConditionSummary {
  std::vector<SweptValue> condition;
  std::vector<MethodSummary> methods;
  std::vector<Comparison> comparisons;    ///< every method against its baseline, headline metrics
  std::vector<Comparison> rivals;         ///< every method against the strongest other one, headline metrics
  std::vector<ErrorBudget> budgets = {};  ///< of the first headline metric, where methods differ in oracles alone
};

/// One comparison under every value of the parameters that a verdict must hold for (`across`): a model of our own, such
/// as how people learn, says nothing about methods where another such model says otherwise.
struct AcrossVerdict {
  std::vector<SweptValue> condition;  ///< of what is swept beside them
  std::string metric;
  std::string baseline;
  std::string method;
  struct Each {
    std::string value;  ///< "learning=power"
    Verdict verdict = Verdict::kInconclusive;
    std::optional<double> difference;
  };
  std::vector<Each> each;
  Verdict verdict = Verdict::kInconclusive;  ///< the one that all agree in, else inconclusive

  bool Holds() const { return verdict != Verdict::kInconclusive; }
};

/// The ruling on something that was said to come out: an expectation, a time rule.
enum class Ruling { kMet, kUnmet, kUndecided };
inline constexpr std::array<Named<Ruling>, 3> kRulings = {
    {{"met", Ruling::kMet}, {"unmet", Ruling::kUnmet}, {"undecided", Ruling::kUndecided}}};
std::string_view RulingName(Ruling ruling);

/// An expectation of a scenario, and whether it came out.
struct ExpectationResult {
  std::string text;  ///< "orientation_error_deg of adaptive below fixed"
  Ruling ruling = Ruling::kUndecided;
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
  int family = 0;  ///< comparisons in all conditions and headline metrics, over which Holm's correction runs
  std::vector<AcrossVerdict> across = {};      ///< empty where verdicts need not hold across anything
  std::string description = {};                ///< what its worlds are, in a sentence; "" = nobody said
  std::vector<std::string> descriptions = {};  ///< what each method is, in a sentence; empty where nobody said of any
};

}  // namespace etude
