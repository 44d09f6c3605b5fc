#pragma once

#include <array>

namespace etude {

/// The frame rates of cameras and motion capture, Hz. A rate of television is 1000 / 1001 of such a rate.
inline constexpr std::array kUsualRates_hz = {24.0,  25.0,  30.0,  48.0,  50.0,  60.0,  72.0,  75.0,  90.0,
                                              100.0, 120.0, 144.0, 150.0, 200.0, 240.0, 250.0, 300.0, 360.0};
inline constexpr double kTelevision = 1000.0 / 1001;

/// Rates of a motion of people, Hz; times that give another rate are in another unit.
inline constexpr double kMinMotionRate_hz = 1, kMaxMotionRate_hz = 10'000;

}  // namespace etude
