#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/model/row.h"
#include "bench/model/unit.h"
#include "engine/base/result.h"

namespace etude {

/// A statement of a scenario about what should come out, judged after the run and shown in the report.
struct Expectation {
  std::string metric;
  std::string of;                           ///< the method judged
  std::string below, above;                 ///< the method it is compared with on the same worlds; at most one is set
  std::optional<double> at_most, at_least;  ///< or the bound its statistic must keep
  std::string statistic = "median";         ///< median, mean or p95; for bounds
  double confidence = 0.95;                 ///< of a comparison: its interval, and 1 − the level of its test
  std::vector<SweptValue> where;            ///< judged in these conditions only; empty = in all of them
  Place place;
};

/// A ratio of processor times measured in the same run, the only way in which times are judged.
struct TimeRatio {
  std::string of, over;  ///< methods
  double at_most = 1;    ///< of the median of paired ratios
  Place place;
};

/// The rule by which single worlds are a regression of their own, whatever all worlds together say: on the same worlds
/// any difference comes from the code. How the defaults were measured: docs/gate.md.
struct TailRule {
  double times = 20;    ///< a world is far worse when it is worse by more than so many practical thresholds
  int worlds = 4;       ///< so many far worse worlds of one comparison are a regression; 0 = none ever is …
  double share = 0.05;  ///< … where they are also so large a share of the worlds compared: rounding moves some of many
  int lost = 1;         ///< so many worlds that lost their value or answer are one; 0 = none ever is
};

/// The rules by which `etude gate` compares one scenario with a baseline.
struct GateRules {
  std::vector<std::string> metrics;  ///< the headline metrics when the file names none
  bool exact = false;                ///< every difference is a regression; else only one that matters (threshold)
  TailRule tail;
  std::vector<TimeRatio> time_ratios;
};

/// One of the methods compared.
struct ComparedMethod {
  std::string name;
  std::string against;      ///< the method it is compared with; the first is its own
  bool has_oracle = false;  ///< part of its work is done by the truth: it shows what could be, and competes with none
  std::vector<std::string> oracle = {};  ///< which stages the truth stands for
  std::string settings = {};     ///< all else that is said of it, the same text for the same; "" = of an outside method
  std::string description = {};  ///< what it is, in a sentence, or the settings that it has
};

/// The comparisons and expectations of a scenario, without how its worlds are made: all that judging its rows takes.
struct Study {
  std::string scenario;
  std::string task;
  std::string question;
  std::string description = {};  ///< what its worlds are, in a sentence; "" = nobody said
  SamplingUnit unit = SamplingUnit::kWorld;
  int trials = 1;
  std::vector<ComparedMethod> methods;              ///< at least one
  std::vector<std::vector<SweptValue>> conditions;  ///< at least one
  std::vector<std::string> metrics;                 ///< headline metrics, most important first
  std::vector<std::string> across;  ///< swept parameters under all of whose values a verdict must be the same
  std::string rival;                ///< the method that all others must beat; "" = the best is found
  std::vector<Expectation> expectations;
  GateRules gate;
};

}  // namespace etude
