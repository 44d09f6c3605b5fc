#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "bench/statistics/beyond.h"
#include "sim/random/stream.h"

namespace etude {

/// The distribution of the differences. Without an effect, the pseudo-median of the units' means is zero. The first
/// five laws are drawn for each world and are symmetric. The others are drawn for each unit; the unit's worlds add
/// normal noise.
enum class SampleLaw {
  kNormal,
  kHeavyTailed,  ///< Student's t of 3 degrees of freedom
  kTies,         ///< normal, but six worlds of ten have a difference of zero
  kShares,       ///< difference of two 0/1 values: −1, 0 or 1
  kCensored,     ///< penalised costs (PAR-2): log-normal; three of ten exceed the limit and count as twice the limit
  kLogNormal,    ///< log-normal with σ = 1
  kFarOff,       ///< normal, but one unit in ten is an outlier by 5 σ
  kBimodal,      ///< −1 or 1, with normal noise of 0.3
};
inline constexpr int kSampleLaws = 8;
inline constexpr int kWorldLaws = 5;  ///< number of the laws that are drawn for each world: the first five
std::string_view SampleLawName(SampleLaw law);

/// The design of a random sample.
struct SampleDesign {
  SampleLaw law = SampleLaw::kNormal;
  int units = 6;
  int trials = 1;    ///< worlds per unit; with `in_pairs`, worlds in all
  /// Correlation of two worlds of one unit, 0…1; for kTies and kCensored before ties are made and the limit applies.
  double alike = 0;
  bool in_pairs = false;  ///< true: each world has two units in two roles; each role carries half of the correlation
  double part_alike = 0;  ///< correlation of one unit's contributions in the two roles
};

/// Returns the practical threshold in the sample's own unit: a third of the law's standard deviation; for shares and
/// penalised costs a sixth, so that an effect of four thresholds is still possible.
double JustMatters(SampleLaw law);

/// Draws a sample. An effect raises the true mean difference by `effect` × JustMatters.
UnitSample DrawSample(const SampleDesign& design, double effect, RandomStream& dice);

/// A share of samples in per cent, with its 95 % Wilson interval.
struct Percentage {
  int count = 0, of = 0;
  double percent = 0;
  double low = 0, high = 100;
};

/// The error rates of verdicts on samples of one design.
struct VerdictRates {
  SampleDesign design;
  /// The share of verdicts *better* or *worse* if there is no difference, judged with a threshold near zero.
  Percentage false_alarms;
  /// The share of false alarms of a test that treats worlds as units.
  Percentage false_alarms_of_worlds;
  /// The share of intervals that contain the true pseudo-median: without an effect, and with an effect of twice the
  /// threshold.
  double coverage_without = 0, coverage_with = 0;
  /// The share of right verdicts if the effect is 1, 2 and 4 times the threshold.
  std::array<double, 3> power{};
};

/// The numbers of samples to draw.
struct VerdictRepetitions {
  int without_effect = 10'000;
  int with_effect = 2'000;  ///< number of samples for each effect size
};

/// Draws the samples of a design, and judges each as the only comparison of its run.
VerdictRates MeasureVerdicts(const SampleDesign& design, const VerdictRepetitions& repetitions);

/// Returns the designs of docs/findings/verdicts.md:
///   - 6, 8, 12 and 30 units × 1, 3 and 10 worlds per unit × correlations of 0, 0.5 and 0.9 × every law of worlds;
///   - 60 worlds with two units each, drawn from 6, 8, 12 and 30 units, × the same correlations × two values of
///     `part_alike` × three laws;
///   - uneven units: 6 to 60 units with one world each × the normal law and the laws of units.
std::vector<SampleDesign> PublishedDesigns();

/// Returns true if the verdicts of a design keep the promise, as far as the samples of `designs` designs can tell:
///   - false alarms do not exceed 5 % (6 % for laws of units): a binomial test finds no excess, at a level of 5 % over
///     all designs together (Bonferroni). Among many designs with exactly 5 %, some draw more by chance;
///   - there are enough samples: the 95 % interval of false alarms ends at 6.5 % or below;
///   - without an effect at least 93 % of the intervals contain the truth.
bool KeepsPromise(const VerdictRates& rates, std::size_t designs);

/// Returns the tables of docs/findings/verdicts.md.
std::string VerdictRatesMarkdown(std::span<const VerdictRates> rates);

}  // namespace etude
