#pragma once

#include <cstdint>

namespace etude {

/// Linear light, 0…1, of a screen's value (IEC 61966-2-1).
double LinearOfSrgb(std::uint8_t value);

/// The screen's value nearest to linear light, which is clamped to 0…1.
std::uint8_t SrgbOfLinear(double light);

}  // namespace etude
