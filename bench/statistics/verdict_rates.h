#pragma once

#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include "bench/statistics/beyond.h"
#include "sim/random/stream.h"

namespace etude {

/// The distribution of the differences of worlds. Without an effect each is symmetric around zero.
enum class SampleLaw {
  kNormal,
  kHeavyTailed,  ///< Student's t of 3 degrees of freedom
  kTies,         ///< normal, but six worlds of ten show no difference
  kShares,       ///< of 0/1 values: −1, 0 or 1
  kCensored,     ///< penalised costs (PAR-2): log-normal, three of ten beyond the limit and counted twice
};
inline constexpr int kSampleLaws = 5;
std::string_view SampleLawName(SampleLaw law);

/// The design of a sample that is to be drawn.
struct SampleDesign {
  SampleLaw law = SampleLaw::kNormal;
  int units = 6;
  int trials = 1;    ///< worlds per unit; with `in_pairs` worlds in all
  double alike = 0;  ///< correlation of two worlds of one unit, 0…1 (of kTies and kCensored before ties and limit)
  bool in_pairs = false;  ///< a world is drawn from two units, in two parts that bring half of the correlation each …
  double part_alike = 0;  ///< … and which correlate by so much for one unit
};

/// Returns the difference that just matters, in the sample's own unit: a third of the worlds' standard deviation; of
/// shares and penalised costs a sixth, for four times as much must still be possible.
double JustMatters(SampleLaw law);

/// Draws a sample whose true mean difference is `effect` × JustMatters.
UnitSample DrawSample(const SampleDesign& design, double effect, RandomStream& dice);

/// A share of samples, in per cent, with its 95 % Wilson interval.
struct Percentage {
  double percent = 0;
  double low = 0, high = 100;
};

/// The error rates of verdicts on samples of one design.
struct VerdictRates {
  SampleDesign design;
  /// The share of *better* or *worse* where nothing differs and the least difference matters.
  Percentage false_alarms;
  /// The share of false alarms when worlds are taken for units, as a test over worlds does.
  Percentage false_alarms_of_worlds;
  /// The share of intervals that hold the true mean: without an effect, and with one of twice what matters.
  double coverage_without = 0, coverage_with = 0;
  /// The share of right verdicts where the effect is 1, 2 and 4 times what matters.
  std::array<double, 3> power{};
};

/// The number of samples that are drawn.
struct VerdictRepetitions {
  int without_effect = 10'000;
  int with_effect = 2'000;  ///< of each size
};

/// Draws a design's samples and judges each as the only comparison of its run.
VerdictRates MeasureVerdicts(const SampleDesign& design, const VerdictRepetitions& repetitions);

/// Returns the designs of docs/findings/verdicts.md: 6, 8, 12 and 30 units × 1, 3 and 10 worlds each × correlations of
/// 0, 0.5 and 0.9 × every law; then 60 worlds of two units each of 6, 8, 12 and 30.
std::vector<SampleDesign> PublishedDesigns();

/// Measures each design; `done` gets the number measured so far after each.
std::vector<VerdictRates> MeasureAll(std::span<const SampleDesign> designs, const VerdictRepetitions& repetitions,
                                     const std::function<void(std::size_t)>& done);

/// Returns whether a design keeps what is promised: false alarms not above 5 % as far as the samples can tell, and
/// below 6.5 % for certain (95 % interval); without an effect, intervals that hold the truth in at least 93 %.
bool KeepsPromise(const VerdictRates& rates);

/// Returns the tables of docs/findings/verdicts.md.
std::string VerdictRatesMarkdown(std::span<const VerdictRates> rates);

}  // namespace etude
