#include "tests/bench/statistics/verdict_rates.h"

#include <fmt/core.h>

#include <cmath>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "bench/statistics/interval.h"
#include "engine/base/order_statistics.h"

namespace etude {
namespace {

/// The chance that a world of kTies has a difference other than zero.
constexpr double kUntied = 0.4;
/// Returns the limit of a cost's logarithm; seven of ten costs stay below it.
double LogLimit() {
  static const double limit = NormalQuantile(0.7);
  return limit;
}

/// Draws from t₃, scaled to a standard deviation of one.
double HeavyTailed(RandomStream& dice) {
  double squares = 0;
  for (int i = 0; i < 3; ++i) {
    const double normal = dice.Normal();
    squares += normal * normal;
  }
  return dice.Normal() / std::sqrt(squares);
}

/// The pseudo-median of e^Z, Z standard normal: the median of the mean of two such values.
constexpr double kLogNormalCentre = 1.2215829;
/// The pseudo-median of a normal value to which 5 is added in one case of ten. Its Walsh averages are normal with
/// variance ½ around 0, 2.5 and 5, with probabilities 0.81, 0.18 and 0.01.
constexpr double kFarOffCentre = 0.2107207;
constexpr double kOffset = 5, kOffsetShare = 0.1;
constexpr double kModeWidth = 0.3;

bool IsOfUnits(SampleLaw law) { return static_cast<int>(law) >= kWorldLaws; }

double DrawContribution(SampleLaw law, RandomStream& dice) {
  switch (law) {
    case SampleLaw::kHeavyTailed:
      return HeavyTailed(dice);
    case SampleLaw::kLogNormal:
      return std::exp(dice.Normal()) - kLogNormalCentre;
    case SampleLaw::kFarOff: {
      const double usual = dice.Normal();
      return usual + (dice.Chance(kOffsetShare) ? kOffset : 0) - kFarOffCentre;
    }
    case SampleLaw::kBimodal: {
      const double mode = dice.Chance(0.5) ? 1 : -1;
      return mode + kModeWidth * dice.Normal();
    }
    default:
      return dice.Normal();
  }
}

/// Draws what a world adds to its unit's contribution.
double DrawNoise(SampleLaw law, RandomStream& dice) {
  return IsOfUnits(law) ? dice.Normal() : DrawContribution(law, dice);
}

/// Draws −1, 0 or 1 with probabilities ¼, ½ and ¼, the difference of two fair coins, with the mean shifted by `effect`.
double CoinsDiffer(double effect, RandomStream& dice) {
  const double drawn = dice.Uniform();
  return drawn < 0.25 - effect / 2 ? -1 : drawn >= 0.75 - effect / 2 ? 1 : 0;
}

double PenalisedCost(double log_cost) { return log_cost > LogLimit() ? 2 * std::exp(LogLimit()) : std::exp(log_cost); }

/// Return the expectation of a penalised cost whose logarithm is normal around `shift` with variance 1, and the
/// expectation of its square for `shift` 0.
double MeanCost(double shift) {
  const double below = LogLimit() - shift;
  return std::exp(shift + 0.5) * NormalCdf(below - 1) + 2 * std::exp(LogLimit()) * NormalCdf(-below);
}
double MeanSquaredCost() { return std::exp(2.0) * NormalCdf(LogLimit() - 2) + 4 * std::exp(2 * LogLimit()) * 0.3; }

/// Returns, by bisection, the shift of the logarithm that changes the mean cost by `effect`.
double ShiftFor(double effect) {
  double low = -20, high = 20;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (MeanCost(middle) - MeanCost(0) < effect ? low : high) = middle;
  }
  return low;
}

/// Draws the worlds of a design: each world is the sum of its units' contributions and of noise of its own.
class Sampler {
 public:
  Sampler(const SampleDesign& design, double effect, RandomStream& dice)
      : design_(design),
        effect_(effect * JustMatters(design.law)),
        shift_(design.law == SampleLaw::kCensored ? ShiftFor(effect_) : 0),
        dice_(dice) {
    sample_.yes_or_no = design.law == SampleLaw::kShares;
    // Draw the contributions of each unit in its first and, correlated with it, in its second role.
    for (int unit = 0; unit < design.units; ++unit) {
      sample_.names.push_back(fmt::format("{:03}", unit));
      Brings& brings = brings_.emplace_back();
      for (double& value : brings.own) value = DrawContribution(design.law, dice);
      for (std::size_t i = 0; i < 2; ++i) {
        const double fresh = DrawContribution(design.law, dice), r = design.part_alike;
        brings.other[i] = r * brings.own[i] + std::sqrt(1 - r * r) * fresh;
      }
      brings.coins = CoinsDiffer(effect_, dice);
    }
  }

  UnitSample Draws() {
    if (!design_.in_pairs) {
      for (int unit = 0; unit < design_.units; ++unit) {
        for (int trial = 0; trial < design_.trials; ++trial) AddWorld({unit});
      }
    } else {
      for (int trial = 0; trial < design_.trials; ++trial) {
        const int left = trial % design_.units;
        const int step = 1 + static_cast<int>(dice_.IndexBelow(static_cast<std::uint64_t>(design_.units - 1)));
        AddWorld({left, (left + step) % design_.units});
      }
    }
    return std::move(sample_);
  }

 private:
  /// The contributions of one unit to its worlds.
  struct Brings {
    std::array<double, 2> own{}, other{};  ///< own: in the first role, other: in the second; [method, baseline]
    double coins = 0;
  };

  /// Draws a standardised value that correlates with the other worlds of the same units.
  double Latent(const std::vector<int>& units, std::size_t of) {
    const Brings& first = brings_[static_cast<std::size_t>(units.front())];
    double shared = first.own[of];
    if (units.size() > 1) shared = (shared + brings_[static_cast<std::size_t>(units[1])].other[of]) / std::sqrt(2.0);
    return std::sqrt(design_.alike) * shared + std::sqrt(1 - design_.alike) * DrawNoise(design_.law, dice_);
  }

  /// Draws the difference method − baseline of one world.
  double Difference(const std::vector<int>& units) {
    switch (design_.law) {
      case SampleLaw::kNormal:
      case SampleLaw::kHeavyTailed:
      case SampleLaw::kLogNormal:
      case SampleLaw::kFarOff:
      case SampleLaw::kBimodal:
        return effect_ + Latent(units, 0);
      case SampleLaw::kTies: {
        const double untied = effect_ / kUntied + Latent(units, 0);
        return dice_.Chance(kUntied) ? untied : 0;
      }
      case SampleLaw::kShares:
        // Each world takes its unit's draw with probability √alike, so two worlds of a unit both take it with
        // probability `alike`, which is then their correlation.
        return dice_.Chance(std::sqrt(design_.alike)) ? brings_[static_cast<std::size_t>(units.front())].coins
                                                      : CoinsDiffer(effect_, dice_);
      case SampleLaw::kCensored:
        break;
    }
    const double method = PenalisedCost(Latent(units, 0) + shift_);
    return method - PenalisedCost(Latent(units, 1));
  }

  void AddWorld(std::vector<int> units) {
    sample_.differences.push_back(KeepThirtyBits(Difference(units)));
    sample_.units.push_back(std::move(units));
  }

  const SampleDesign& design_;
  const double effect_, shift_;
  RandomStream& dice_;
  std::vector<Brings> brings_;
  UnitSample sample_;
};

}  // namespace

std::string_view SampleLawName(SampleLaw law) {
  constexpr std::array<std::string_view, kSampleLaws> kNames = {"normal",   "t₃",         "ties",           "shares",
                                                                "censored", "log-normal", "one in ten off", "bimodal"};
  return kNames[static_cast<std::size_t>(law)];
}

double JustMatters(SampleLaw law) {
  switch (law) {
    case SampleLaw::kNormal:
    case SampleLaw::kHeavyTailed:
      return 1.0 / 3;
    case SampleLaw::kTies:
      return std::sqrt(kUntied) / 3;
    case SampleLaw::kShares:
      return std::sqrt(0.5) / 6;
    case SampleLaw::kLogNormal:
      return std::sqrt((std::exp(1.0) - 1) * std::exp(1.0)) / 3;
    case SampleLaw::kFarOff:
      return std::sqrt(1 + kOffsetShare * (1 - kOffsetShare) * kOffset * kOffset) / 3;
    case SampleLaw::kBimodal:
      return std::sqrt(1 + kModeWidth * kModeWidth) / 3;
    case SampleLaw::kCensored:
      break;
  }
  return std::sqrt(2 * (MeanSquaredCost() - MeanCost(0) * MeanCost(0))) / 6;
}

UnitSample DrawSample(const SampleDesign& design, double effect, RandomStream& dice) {
  return Sampler(design, effect, dice).Draws();
}

namespace {

constexpr std::array kEffects = {1.0, 2.0, 4.0};

/// Makes a lower-is-better metric with this practical threshold.
MetricInfo MetricOf(double practical) {
  MetricInfo metric;
  metric.id = "calibration";
  metric.practical = practical;
  return metric;
}

/// Judges the sample as the only comparison: no correction for others.
std::optional<Verdict> Judge(Beyond& beyond, const MetricInfo& metric) {
  beyond.p_holm = beyond.test.p;
  return VerdictBeyond(beyond, metric);
}

bool IsClear(std::optional<Verdict> verdict) { return verdict == Verdict::kBetter || verdict == Verdict::kWorse; }

/// Returns true if a paired t test at 5 % that treats worlds as units finds a difference.
bool TestOverWorldsAlarms(const UnitSample& sample) {
  const double n = static_cast<double>(sample.differences.size());
  double mean = 0, squares = 0;
  for (double difference : sample.differences) mean += difference / n;
  for (double difference : sample.differences) squares += (difference - mean) * (difference - mean);
  const int freedom = static_cast<int>(sample.differences.size()) - 1;
  return std::abs(mean) > StudentQuantile(1 - kAlpha / 2, freedom) * std::sqrt(squares / freedom / n);
}

Percentage PercentageOf(int count, int of) {
  const Interval interval = WilsonInterval(count, of);
  return {count, of, 100.0 * count / of, 100 * interval.low, 100 * interval.high};
}

std::string PurposeOf(const SampleDesign& design, double effect) {
  return fmt::format("{}/{}/{}/{}/{}/{}/{}", SampleLawName(design.law), design.units, design.trials, design.alike,
                     design.in_pairs, design.part_alike, effect);
}

/// Returns the true pseudo-median of the units' means under an effect. If the effect only shifts a law, the
/// pseudo-median shifts by as much as the mean. If the effect changes the law's shape, the pseudo-median is estimated
/// by the median of 20,000 means of two units.
double TruthOf(const SampleDesign& design, double effect) {
  // If each unit has one yes-or-no world, the verdict is about the mean.
  const bool changes_shape = design.law == SampleLaw::kTies || design.law == SampleLaw::kCensored ||
                             (design.law == SampleLaw::kShares && design.trials > 1);
  if (design.in_pairs || !changes_shape) return effect * JustMatters(design.law);
  SampleDesign two = design;
  two.units = 2;
  std::vector<double> means;
  for (int i = 0; i < 20'000; ++i) {
    RandomStream dice({.suite_seed = 1, .scenario = "truth of verdicts", .trial = i}, PurposeOf(design, effect));
    means.push_back(Mean(DrawSample(two, effect, dice).differences));
  }
  return Quantile(means, 0.5);
}

bool Holds(const Beyond& beyond, double truth) {
  // A tolerance, because the interval of a sample of shares without any difference has no width.
  return *beyond.low <= truth + 1e-9 && truth - 1e-9 <= *beyond.high;
}

/// Measures the false alarms and the coverage where nothing differs.
void MeasureFalseAlarms(int repetitions, VerdictRates& rates) {
  const MetricInfo metric = MetricOf(1e-9);
  const std::string purpose = PurposeOf(rates.design, 0);
  int alarms = 0, of_worlds = 0, held = 0;
  for (int i = 0; i < repetitions; ++i) {
    RandomStream dice({.suite_seed = 1, .scenario = "verdicts", .trial = i}, purpose);
    const UnitSample sample = DrawSample(rates.design, 0, dice);
    Beyond beyond = MeasureBeyond(sample, 1);
    held += Holds(beyond, 0);
    alarms += IsClear(Judge(beyond, metric));
    of_worlds += TestOverWorldsAlarms(sample);
  }
  rates.false_alarms = PercentageOf(alarms, repetitions);
  rates.false_alarms_of_worlds = PercentageOf(of_worlds, repetitions);
  rates.coverage_without = 100.0 * held / repetitions;
}

/// Measures the power at each effect size, and the coverage at twice the threshold.
void MeasurePower(int repetitions, VerdictRates& rates) {
  const double matters = JustMatters(rates.design.law);
  const MetricInfo metric = MetricOf(matters);
  for (std::size_t k = 0; k < kEffects.size(); ++k) {
    const std::string purpose = PurposeOf(rates.design, kEffects[k]);
    const double truth = kEffects[k] == 2 ? TruthOf(rates.design, kEffects[k]) : 0;
    int found = 0, held = 0;
    for (int i = 0; i < repetitions; ++i) {
      RandomStream dice({.suite_seed = 1, .scenario = "verdicts", .trial = i}, purpose);
      Beyond beyond = MeasureBeyond(DrawSample(rates.design, kEffects[k], dice), 1);
      held += kEffects[k] == 2 && Holds(beyond, truth);
      found += Judge(beyond, metric) == Verdict::kWorse;
    }
    rates.power[k] = 100.0 * found / repetitions;
    if (kEffects[k] == 2) rates.coverage_with = 100.0 * held / repetitions;
  }
}

}  // namespace

VerdictRates MeasureVerdicts(const SampleDesign& design, const VerdictRepetitions& repetitions) {
  VerdictRates rates;
  rates.design = design;
  MeasureFalseAlarms(repetitions.without_effect, rates);
  MeasurePower(repetitions.with_effect, rates);
  return rates;
}

std::vector<SampleDesign> PublishedDesigns() {
  std::vector<SampleDesign> designs;
  // Each world is drawn from one unit.
  for (int units : {6, 8, 12, 30}) {
    for (int trials : {1, 3, 10}) {
      for (double alike : {0.0, 0.5, 0.9}) {
        for (int law = 0; law < kWorldLaws; ++law) {
          designs.push_back({.law = static_cast<SampleLaw>(law), .units = units, .trials = trials, .alike = alike});
        }
      }
    }
  }
  // Two units per world.
  for (int units : {6, 8, 12, 30}) {
    for (double alike : {0.0, 0.5, 0.9}) {
      for (double part_alike : {0.0, 0.8}) {
        for (SampleLaw law : {SampleLaw::kNormal, SampleLaw::kHeavyTailed, SampleLaw::kTies}) {
          designs.push_back({law, units, 60, alike, true, part_alike});
        }
      }
    }
  }
  // One world per unit; worlds differ only by their units' contributions.
  for (int units : {6, 8, 10, 12, 20, 30, 60}) {
    for (SampleLaw law : {SampleLaw::kNormal, SampleLaw::kLogNormal, SampleLaw::kFarOff, SampleLaw::kBimodal}) {
      designs.push_back({.law = law, .units = units, .trials = 1, .alike = 1});
    }
  }
  return designs;
}

bool KeepsPromise(const VerdictRates& rates, std::size_t designs) {
  const Percentage& alarms = rates.false_alarms;
  if (alarms.of == 0) return false;
  // A one-sided score test finds a rate above the promised one if the Wilson interval of confidence 1 − 2 · level lies
  // above the promised rate.
  const double level = 0.05 / static_cast<double>(designs), promised = IsOfUnits(rates.design.law) ? 0.06 : 0.05;
  return WilsonInterval(alarms.count, alarms.of, 1 - 2 * level).low <= promised && alarms.high <= 6.5 &&
         rates.coverage_without >= 93;
}

std::string VerdictRatesMarkdown(std::span<const VerdictRates> rates) {
  std::string one_way, pairs, uneven;
  double of_worlds = 0;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const SampleDesign& design = rates[i].design;
    // A row holds the distributions of one design side by side; the normal one comes first.
    const bool is_uneven = !design.in_pairs && design.alike == 1;
    std::string& table = is_uneven ? uneven : design.in_pairs ? pairs : one_way;
    if (design.law == SampleLaw::kNormal) {
      table += fmt::format("| {} |", design.units);
      if (!is_uneven) {
        table += fmt::format(" {} | {} |", design.in_pairs ? design.part_alike : design.trials, design.alike);
      }
      of_worlds = rates[i].false_alarms_of_worlds.percent;
    }
    table += fmt::format(" {:.1f} · {:.0f} · {:.0f} · {:.0f}/{:.0f}/{:.0f} |", rates[i].false_alarms.percent,
                         rates[i].coverage_without, rates[i].coverage_with, rates[i].power[0], rates[i].power[1],
                         rates[i].power[2]);
    const bool ends = i + 1 == rates.size() || rates[i + 1].design.law == SampleLaw::kNormal;
    if (ends) table += is_uneven ? "\n" : fmt::format(" {:.0f} |\n", of_worlds);
  }
  std::string text = "| units | worlds each | correlation |";
  for (int law = 0; law < kWorldLaws; ++law) text += fmt::format(" {} |", SampleLawName(static_cast<SampleLaw>(law)));
  text += " over worlds |\n|---|---|---|---|---|---|---|---|---|\n" + one_way;
  if (!pairs.empty()) {
    text +=
        "\n| units | parts alike | correlation | normal | t₃ | ties | over worlds |\n|---|---|---|---|---|---|---|\n";
    text += pairs;
  }
  if (uneven.empty()) return text;
  return text + "\n| units | normal | log-normal | one in ten off | bimodal |\n|---|---|---|---|---|\n" + uneven;
}

}  // namespace etude
