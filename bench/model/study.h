#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/unit.h"
#include "engine/base/result.h"

namespace etude {

/// A claim that a scenario makes about its results. It is judged after the run and shown in the report.
struct Expectation {
  std::string metric;
  std::string of;  ///< the method to which the claim applies
  /// The other method, if there is one: the claim is "`of` is below `below`" or "`of` is above `above`", in the same
  /// worlds. At most one of the two is set.
  std::string below, above;
  /// Bounds of `statistic` of the method `of`. They are set only if `of` is not compared with another method.
  std::optional<double> at_most, at_least;
  std::string statistic = "median";  ///< "median", "mean" or "p95"; used only for bounds
  /// Confidence level of a comparison's interval. The significance level of the comparison's test is 1 − confidence.
  double confidence = 0.95;
  std::vector<SweptValue> where;  ///< the conditions under which the claim is judged; empty = all conditions
  Place place;
};

/// A bound on the ratio of two methods' processor times in one run. Times are judged only by ratios within a run,
/// because runs on different machines cannot be compared.
struct TimeRatio {
  std::string of, over;  ///< the ratio is the time of method `of` divided by the time of method `over`
  double at_most = 1;    ///< the largest allowed median of the paired ratios
  Place place;
};

/// The rule by which a few far worse worlds count as a regression, even if the statistics over all worlds show no
/// change. Both compared runs have the same worlds, so every difference comes from the code. docs/gate.md explains how
/// the defaults were measured.
struct TailRule {
  double times = 20;  ///< a world is far worse if it is worse by more than this many practical thresholds
  /// A comparison with at least this many far worse worlds is a regression; 0 = never.
  int worlds = 4;
  /// The smallest share of the compared worlds that must be far worse for a regression. It applies in addition to
  /// `worlds`, because rounding may change a few worlds if there are many.
  double share = 0.05;
  /// A comparison is a regression if at least this many worlds have a value or an answer in the baseline but not in the
  /// new run; 0 = never.
  int lost = 1;
};

/// The rules by which `etude gate` compares one scenario with a baseline.
struct GateRules {
  /// Metrics to compare; if the scenario names none, the success metric and the headline metrics.
  std::vector<std::string> metrics;
  bool exact = false;  ///< true: every difference is a regression, even below the practical threshold
  TailRule tail;
  std::vector<TimeRatio> time_ratios;
};

struct ComparedMethod {
  std::string name;
  std::string against;  ///< the method with which this method is compared; the first method names itself
  /// True: ground truth replaces some processing stages, so the method is an upper bound and no competitor.
  bool has_oracle = false;
  std::vector<std::string> oracle = {};  ///< the processing stages whose output is replaced by ground truth
  std::string settings = {};             ///< the method's settings besides `oracle`, as text; equal settings have equal
                                         ///< texts; "" = outside method
  std::string description = {};          ///< a sentence about the method, or the method's settings
};

/// The comparisons and expectations of a scenario, and everything else that is needed to judge the scenario's rows. It
/// does not describe how the scenario's worlds are made.
struct Study {
  std::string scenario;
  std::string task;
  std::string question;
  std::string description = {};  ///< a sentence about the study's worlds; "" = not described
  SamplingUnit unit = SamplingUnit::kWorld;
  int trials = 1;
  std::vector<ComparedMethod> methods;              ///< at least one method
  std::vector<std::vector<SweptValue>> conditions;  ///< at least one condition
  std::vector<std::string> metrics;                 ///< headline metrics, most important first
  std::vector<std::string> across;  ///< swept parameters; a verdict must be the same under all their values
  /// The metric that says whether the task's goal was reached; answers compare it before the value metric. "" = the
  /// task has none.
  std::string success;
  double success_matters = 0.05;  ///< the smallest difference of success that matters, as a share
  std::string rival;              ///< the method that all others must beat; "" = FindRival chooses the best method
  std::vector<Expectation> expectations;
  GateRules gate;
};

}  // namespace etude
