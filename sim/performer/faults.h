#pragma once

#include <span>
#include <string>
#include <vector>

#include "sim/choreography/move.h"
#include "sim/performer/session.h"

namespace etude {

/// The share of every angle that a half-hearted performance shows.
constexpr double kHalfAmplitude = 0.5;

/// The faults that would truly be faults of `asked`: their motion stays clearly (8 degrees) away from
/// its key poses. `kSkipped` is always among them.
std::vector<Fault> ShowableFaults(const Move& asked, std::span<const Move> moves);

/// The moves that can be danced by mistake: those that stay clearly away from `asked`'s key poses.
std::vector<std::string> WrongMoves(const Move& asked, std::span<const Move> moves);

}  // namespace etude
