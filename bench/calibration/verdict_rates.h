#pragma once

#include <functional>
#include <span>
#include <vector>

#include "bench/calibration/samples.h"

namespace etude {

/// A share of samples, in per cent, with its 95 % Wilson interval.
struct Percentage {
  double percent = 0;
  double low = 0, high = 100;
};

/// What verdicts beyond the worlds of a design were worth.
struct VerdictRates {
  SampleDesign design;
  /// Nothing differs, and the least difference matters: *better* or *worse* all the same.
  Percentage false_alarms;
  /// The same when worlds are taken for units, as a test over worlds does.
  Percentage false_alarms_of_worlds;
  /// The interval holds the true mean: without an effect, and with one of twice what matters.
  double coverage_without = 0, coverage_with = 0;
  /// *Worse* or *better*, as it truly is, of 1, 2 and 4 times what matters.
  std::array<double, 3> power{};
};

/// How many samples are drawn.
struct VerdictRepetitions {
  int without_effect = 10'000;
  int with_effect = 2'000;  ///< of each size
};

/// Draws a design's samples and judges each as the only comparison of its run.
VerdictRates MeasureVerdicts(const SampleDesign& design, const VerdictRepetitions& repetitions);

/// The designs of docs/results.md: 6, 8, 12 and 30 units × 1, 3 and 10 worlds each × correlations of 0, 0.5 and 0.9 ×
/// every law; then 60 worlds of two units each of 6, 8, 12 and 30.
std::vector<SampleDesign> PublishedDesigns();

/// Measures each; `done` is told after each how many are.
std::vector<VerdictRates> MeasureAll(std::span<const SampleDesign> designs, const VerdictRepetitions& repetitions,
                                     const std::function<void(std::size_t)>& done);

/// What a design must keep: false alarms not above 5 % as far as the samples can tell, and below 6.5 % for certain (95
/// % interval); without an effect, intervals that hold the truth in at least 93 %.
bool KeepsPromise(const VerdictRates& rates);

/// The tables of docs/results.md.
std::string VerdictRatesMarkdown(std::span<const VerdictRates> rates);

}  // namespace etude
