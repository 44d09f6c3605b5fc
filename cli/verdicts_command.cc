#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "bench/calibration/verdict_rates.h"
#include "cli/commands.h"

namespace etude {

int VerdictsCommand(int repetitions) {
  const std::vector<SampleDesign> designs = PublishedDesigns();
  const auto tell = [&](std::size_t done) { fmt::print(stderr, "\r{} of {} designs", done, designs.size()); };
  const auto rates = MeasureAll(designs, {repetitions, std::max(repetitions / 5, 1)}, tell);
  std::fputs("\n\n", stderr);
  fmt::print("{}\n", VerdictRatesMarkdown(rates));
  const auto broken = std::count_if(rates.begin(), rates.end(), [](const auto& one) { return !KeepsPromise(one); });
  fmt::print(
      "{} of {} designs keep the promise: false alarms at most 5 % (upper end of the 95 % interval 6.5 %), intervals "
      "that hold "
      "the truth in at least 93 %.\n",
      rates.size() - static_cast<std::size_t>(broken), rates.size());
  return broken == 0 ? kSuccess : kRegression;
}

}  // namespace etude
