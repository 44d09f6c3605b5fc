#pragma once

#include <functional>
#include <vector>

#include "engine/recognition/taught_move.h"
#include "engine/teaching/labelled_streams.h"

namespace etude {

/// Teaches every move of these parts, by name: right performances are examples, wrong ones counter-examples. An action
/// point is only a moment, so its performance is taken from half-way after the preceding action point, at most two
/// seconds before, to at most one second after it (ours). Parts for which `takes` returns false are left out. Fails as
/// TeachMove does; without `is_strict`, a performance that cannot be used is left out, and so is a move without a
/// usable right performance.
Result<std::vector<TaughtMove>> TeachMoves(const std::vector<NamedStream>& streams,
                                           const std::vector<LabelledPart>& parts,
                                           const std::function<bool(const LabelledPart&)>& takes, bool is_strict);

/// Returns the performances that TeachMoves learns from, in the order of the parts, as PerformancesOf cuts them.
std::vector<LabelledPart> PerformancesToLearn(const std::vector<NamedStream>& streams,
                                              const std::vector<LabelledPart>& parts,
                                              const std::function<bool(const LabelledPart&)>& takes, bool is_strict);

/// Returns the parts with action points turned into performances as above; the others stay as they are.
std::vector<LabelledPart> PerformancesOf(const std::vector<LabelledPart>& parts,
                                         const std::vector<NamedStream>& streams);

}  // namespace etude
