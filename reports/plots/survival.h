#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/model/run_data.h"

namespace etude {

/// What a cell took until it was done; nothing when it never was.
struct Outcome {
  std::optional<double> took;
};

/// The share not yet done, in per cent, after each time at which one was: (time, share) pairs, beginning with 100. What
/// never is done stays in the denominator to the end, so that a method which gives up early gains nothing by it; with a
/// common limit this is Kaplan and Meier's curve. Empty without outcomes.
std::vector<std::pair<double, double>> NotYetDone(const std::vector<Outcome>& outcomes);

/// Curves of what is censored in this scenario (solver steps of what was not solved, waits without an end), a line per
/// method and a panel per condition; "" where nothing is.
std::string SurvivalHtml(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
