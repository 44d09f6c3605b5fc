#pragma once

#include <span>
#include <vector>

namespace etude {

/// A click on every beat, the first of four higher: samples in [-1, 1] of one channel, `duration_s` long. `beats_s`
/// ascend; beats outside are silent.
std::vector<double> ClickTrack(std::span<const double> beats_s, double duration_s, int rate_hz = 44100);

}  // namespace etude
