#pragma once

#include <span>
#include <string>

namespace etude {

/// Writes sound of one channel as the bytes of a WAV file (RIFF, PCM, 16 bits, little-endian). Samples beyond [-1, 1]
/// are cut off; `rate_hz` > 0.
std::string WriteWav(std::span<const double> samples, int rate_hz);

}  // namespace etude
