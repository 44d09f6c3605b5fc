#pragma once

#include <optional>
#include <span>
#include <vector>

namespace etude {

/// Returns the rate that best fits steps of one to three frames, starting from the rate of the median step. If
/// `only_clear_steps`, steps about half-way between whole numbers of frames are left out; they occur beside a row at a
/// wrong time.
double FittedRate(const std::vector<double>& steps, bool only_clear_steps);

/// Returns the mean time between rows that come in bursts, as receive times of sockets and pipes do: mostly, rows
/// follow each other much faster than on average, at most eight rows in a burst on average, and the bursts have a steady
/// rate of rows. Returns nullopt for other rows. `times` ascend, in any unit.
std::optional<double> MeanStepOfBursts(std::span<const double> times);

/// Returns the rate of rows of which none is missing although their times are uneven: at the mean rate, each row is
/// within one frame of its place. The rate is `told_hz` or a whole rate if either fits as well. Returns nullopt for
/// other rows.
std::optional<double> RateOfUnevenRows(std::span<const double> times_s, std::optional<double> told_hz);

}  // namespace etude
