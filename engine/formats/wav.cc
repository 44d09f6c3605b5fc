#include "engine/formats/wav.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace etude {
namespace {

void Append(std::uint32_t value, int bytes, std::string& out) {
  for (int i = 0; i < bytes; ++i) out.push_back(static_cast<char>(value >> (8 * i)));
}

}  // namespace

std::string WriteWav(std::span<const double> samples, int rate_hz) {
  constexpr int kBytes = 2, kPcm = 1, kChannels = 1;
  const auto rate = static_cast<std::uint32_t>(rate_hz);
  const auto data = static_cast<std::uint32_t>(samples.size() * kBytes);
  // Write the RIFF header with the format.
  std::string out = "RIFF";
  Append(36 + data, 4, out);
  out += "WAVEfmt ";
  Append(16, 4, out);
  Append(kPcm, 2, out);
  Append(kChannels, 2, out);
  Append(rate, 4, out);
  Append(rate * kBytes * kChannels, 4, out);
  Append(kBytes * kChannels, 2, out);
  Append(8 * kBytes, 2, out);
  // Write the samples.
  out += "data";
  Append(data, 4, out);
  for (double sample : samples) {
    const auto level = static_cast<std::int16_t>(std::lround(std::clamp(sample, -1.0, 1.0) * 32767));
    Append(static_cast<std::uint16_t>(level), kBytes, out);
  }
  return out;
}

}  // namespace etude
