#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/blind_files.h"
#include "bench/statistics/interval.h"

namespace etude {

/// wins[i][j] is the number of times that item i was preferred to item j; "no difference" is half a win for both.
using WinTable = std::vector<std::vector<double>>;

/// Fits the model of Bradley and Terry (1952): i is preferred to j with probability s_i / (s_i + s_j). Returns the
/// strengths of maximum likelihood, whose sum is 1, by the MM algorithm (Hunter 2004, equation 3). An item without a
/// win has strength 0. Two strengths can be compared only if comparisons connect their items, directly or through other
/// items.
std::vector<double> FitBradleyTerry(const WinTable& wins);

/// The preferences of people for the films of one method.
struct PreferredMethod {
  std::string method;
  double wins = 0, answers = 0;
  /// Probability of being preferred, averaged over the methods with which this method was compared.
  std::optional<double> share;
  std::optional<Interval> interval;  ///< resampled over raters; nullopt below kMinSample raters
};

/// The agreement of a metric with the raters: how often more raters prefer the film with the better value of the
/// metric. A pair counts if one side has more votes than the other (the answer "no difference" is not a vote) and the
/// metric's two values differ.
struct MetricAgreement {
  std::string metric;
  int agreed = 0, decided = 0;
  int equal = 0, missing = 0;             ///< pairs in which the raters prefer one film, but the metric's values are
                                          ///< equal or missing
  std::optional<Interval> interval = {};  ///< Wilson interval over pairs
};

/// A rater who chose one side so often (two-sided p < 0.01 of a fair coin) that the answers may not be about the films.
/// Sides are drawn at random, so a rater who looks at the films chooses left and right about equally often.
struct OneSidedRater {
  std::string rater;
  int left = 0, decided = 0;
};

struct Preferences {
  int raters = 0, pairs = 0;
  int answers = 0, same = 0, without = 0;  ///< `same`: answers "no difference"; `without`: pairs without answer
  std::vector<PreferredMethod> methods;    ///< methods, the most preferred first
  std::vector<MetricAgreement> metrics;    ///< metrics, the largest share of agreement first
  std::vector<OneSidedRater> one_sided;
};

/// Summarises checked files (CheckBlindFiles). Intervals of methods are BCa intervals of raters drawn with replacement,
/// from a stream keyed by `seed`; raters with the same name in several files are one rater.
Preferences MeasurePreferences(const BlindFiles& files, std::uint64_t seed);

}  // namespace etude
