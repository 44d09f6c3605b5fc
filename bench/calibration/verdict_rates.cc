#include "bench/calibration/verdict_rates.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bench/statistics/distributions.h"
#include "bench/statistics/interval.h"

namespace etude {
namespace {

constexpr std::array kEffects = {1.0, 2.0, 4.0};

/// Lower is better, by as little as `practical`.
MetricInfo MetricOf(double practical) {
  MetricInfo metric;
  metric.id = "calibration";
  metric.practical = practical;
  return metric;
}

std::optional<Verdict> Judge(Beyond& beyond, const MetricInfo& metric) {
  beyond.p_holm = beyond.test.p;
  return VerdictBeyond(beyond, metric);
}

bool IsClear(std::optional<Verdict> verdict) { return verdict == Verdict::kBetter || verdict == Verdict::kWorse; }

/// What a paired t test that takes worlds for units says at 5 %.
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
  return {100.0 * count / of, 100 * interval.low, 100 * interval.high};
}

std::string PurposeOf(const SampleDesign& design, double effect) {
  return fmt::format("{}/{}/{}/{}/{}/{}/{}", SampleLawName(design.law), design.units, design.trials, design.alike,
                     design.in_pairs, design.part_alike, effect);
}

bool Holds(const Beyond& beyond, double truth) {
  // A sample of shares without any difference has an interval without width.
  return *beyond.low <= truth + 1e-9 && truth - 1e-9 <= *beyond.high;
}

void MeasureFalseAlarms(int repetitions, VerdictRates& rates) {
  const MetricInfo metric = MetricOf(1e-9);
  const std::string purpose = PurposeOf(rates.design, 0);
  int alarms = 0, of_worlds = 0, held = 0;
  for (int i = 0; i < repetitions; ++i) {
    RandomStream dice({.suite_seed = 1, .scenario = "verdicts", .trial = i}, purpose);
    const UnitSample sample = DrawSample(rates.design, 0, dice);
    Beyond beyond = MeasureBeyond(sample, 1, 1, purpose);
    held += Holds(beyond, 0);
    alarms += IsClear(Judge(beyond, metric));
    of_worlds += TestOverWorldsAlarms(sample);
  }
  rates.false_alarms = PercentageOf(alarms, repetitions);
  rates.false_alarms_of_worlds = PercentageOf(of_worlds, repetitions);
  rates.coverage_without = 100.0 * held / repetitions;
}

void MeasurePower(int repetitions, VerdictRates& rates) {
  const double matters = JustMatters(rates.design.law);
  const MetricInfo metric = MetricOf(matters);
  for (std::size_t k = 0; k < kEffects.size(); ++k) {
    const std::string purpose = PurposeOf(rates.design, kEffects[k]);
    int found = 0, held = 0;
    for (int i = 0; i < repetitions; ++i) {
      RandomStream dice({.suite_seed = 1, .scenario = "verdicts", .trial = i}, purpose);
      Beyond beyond = MeasureBeyond(DrawSample(rates.design, kEffects[k], dice), 1, 1, purpose);
      held += Holds(beyond, kEffects[k] * matters);
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
  for (int units : {6, 8, 12, 30}) {
    for (int trials : {1, 3, 10}) {
      for (double alike : {0.0, 0.5, 0.9}) {
        for (int law = 0; law < kSampleLaws; ++law) {
          designs.push_back({.law = static_cast<SampleLaw>(law), .units = units, .trials = trials, .alike = alike});
        }
      }
    }
  }
  for (int units : {6, 8, 12, 30}) {
    for (double alike : {0.0, 0.5, 0.9}) {
      for (double part_alike : {0.0, 0.8}) {
        for (SampleLaw law : {SampleLaw::kNormal, SampleLaw::kHeavyTailed, SampleLaw::kTies}) {
          designs.push_back({law, units, 60, alike, true, part_alike});
        }
      }
    }
  }
  return designs;
}

std::vector<VerdictRates> MeasureAll(std::span<const SampleDesign> designs, const VerdictRepetitions& repetitions,
                                     const std::function<void(std::size_t)>& done) {
  std::vector<VerdictRates> rates;
  for (const SampleDesign& design : designs) {
    rates.push_back(MeasureVerdicts(design, repetitions));
    done(rates.size());
  }
  return rates;
}

bool KeepsPromise(const VerdictRates& rates) {
  return rates.false_alarms.low <= 5 && rates.false_alarms.high <= 6.5 && rates.coverage_without >= 93;
}

std::string VerdictRatesMarkdown(std::span<const VerdictRates> rates) {
  std::string one_way, pairs;
  for (std::size_t i = 0; i < rates.size(); ++i) {
    const SampleDesign& design = rates[i].design;
    std::string& table = design.in_pairs ? pairs : one_way;
    const bool begins = design.law == SampleLaw::kNormal;
    if (begins) {
      table += fmt::format("| {} | {} | {} |", design.units, design.in_pairs ? design.part_alike : design.trials,
                           design.alike);
    }
    table += fmt::format(" {:.1f} · {:.0f} · {:.0f} · {:.0f}/{:.0f}/{:.0f} |", rates[i].false_alarms.percent,
                         rates[i].coverage_without, rates[i].coverage_with, rates[i].power[0], rates[i].power[1],
                         rates[i].power[2]);
    const bool ends = i + 1 == rates.size() || rates[i + 1].design.law == SampleLaw::kNormal;
    if (ends)
      table +=
          fmt::format(" {:.0f} |\n", rates[i + 1 - (design.in_pairs ? 3 : kSampleLaws)].false_alarms_of_worlds.percent);
  }
  std::string text = "| units | worlds each | correlation |";
  for (int law = 0; law < kSampleLaws; ++law) text += fmt::format(" {} |", SampleLawName(static_cast<SampleLaw>(law)));
  text += " over worlds |\n|---|---|---|---|---|---|---|---|---|\n" + one_way;
  if (pairs.empty()) return text;
  return text +
         "\n| units | parts alike | correlation | normal | t₃ | ties | over worlds |\n|---|---|---|---|---|---|---|\n" +
         pairs;
}

}  // namespace etude
