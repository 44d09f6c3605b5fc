#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace etude {

/// The frame rates of cameras and motion capture, Hz. A rate of television is 1000 / 1001 of such a rate.
inline constexpr std::array kUsualRates_hz = {24.0,  25.0,  30.0,  48.0,  50.0,  60.0,  72.0,  75.0,  90.0,
                                              100.0, 120.0, 144.0, 150.0, 200.0, 240.0, 250.0, 300.0, 360.0};
inline constexpr double kTelevision = 1000.0 / 1001;

/// Rates of a motion of people, Hz; times that give another rate are in another unit.
inline constexpr double kMinMotionRate_hz = 1, kMaxMotionRate_hz = 10'000;

/// Returns the rate that best fits steps of one to three frames, starting from the rate of the median step. If
/// `only_clear_steps`, steps about half-way between whole numbers of frames are left out; they occur before and after a
/// row at a wrong time.
double FittedRate(const std::vector<double>& steps, bool only_clear_steps);

/// Returns the mean time between rows that come in bursts. A program that stores the time at which it receives a row
/// from a socket or pipe writes such rows: most steps between rows are much shorter than the mean step, a burst has at
/// most eight rows on average, and over the bursts the rate of rows is steady. Returns nullopt for other rows. `times`
/// ascend, in any unit.
std::optional<double> MeanStepOfBursts(std::span<const double> times);

/// Returns the rate of rows whose times are uneven although no row is missing: at the mean rate, each row is within one
/// frame of its place. The rate is `told_hz` or a whole rate if either fits as well. Returns nullopt for other rows.
std::optional<double> RateOfUnevenRows(std::span<const double> times_s, std::optional<double> told_hz);

}  // namespace etude
