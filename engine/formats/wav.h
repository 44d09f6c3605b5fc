#pragma once

#include <span>
#include <string>

namespace etude {

/// Returns one channel of sound as the bytes of a WAV file (RIFF, PCM, 16 bits, little-endian). Samples outside [-1, 1]
/// are clipped; `rate_hz` > 0.
std::string WriteWav(std::span<const double> samples, int rate_hz);

}  // namespace etude
