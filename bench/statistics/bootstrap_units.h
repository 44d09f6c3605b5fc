#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/statistics/bootstrap.h"
#include "bench/statistics/distributions.h"
#include "sim/random/stream.h"

namespace etude {

/// Returns the BCa interval of each figure of a sample of units, from 1,999 resamples of whole units that `dice` draws.
/// `figures` are the sample's own figures, and `measure` returns those of other units, in the same order; a figure may
/// be missing. Samples of fewer than kMinSample units have no intervals.
template <typename Unit, typename Measure>
std::vector<std::optional<Interval>> BootstrapUnits(std::span<const Unit> units,
                                                    std::span<const std::optional<double>> figures, RandomStream dice,
                                                    const Measure& measure) {
  constexpr std::size_t kResamples = 1999;
  std::vector<std::optional<Interval>> intervals(figures.size());
  if (static_cast<int>(units.size()) < kMinSample) return intervals;
  std::vector<std::vector<double>> replicates(figures.size()), jackknife(figures.size());
  const auto add = [&](std::span<const Unit> chosen, std::vector<std::vector<double>>& lists) {
    const auto found = measure(chosen);
    for (std::size_t k = 0; k < lists.size(); ++k) {
      if (found[k]) lists[k].push_back(KeepThirtyBits(*found[k]));
    }
  };
  std::vector<Unit> drawn(units.begin(), units.end());
  for (std::size_t i = 0; i < kResamples; ++i) {
    for (Unit& one : drawn) one = units[dice.IndexBelow(units.size())];
    add(drawn, replicates);
  }
  for (std::size_t left_out = 0; left_out < units.size(); ++left_out) {
    std::vector<Unit> others(units.begin(), units.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(left_out));
    add(others, jackknife);
  }
  for (std::size_t k = 0; k < figures.size(); ++k) {
    if (!figures[k] || replicates[k].empty()) continue;
    intervals[k] = BcaInterval(replicates[k], KeepThirtyBits(*figures[k]), jackknife[k]);
  }
  return intervals;
}

}  // namespace etude
