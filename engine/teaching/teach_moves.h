#pragma once

#include <functional>
#include <vector>

#include "engine/recognition/taught_move.h"
#include "engine/teaching/labelled_streams.h"

namespace etude {

/// Teaches every move that occurs in these parts, in alphabetical order of the moves' names. Right performances
/// become examples, wrong performances become counter-examples. An action point is a single time; the performance is
/// taken to begin at most two seconds before and to end at most one second after the action point, but not beyond the
/// middle between two neighbouring action points (ours). Parts for which `takes` returns false are left out. Fails if
/// `TeachMove` fails. Without `is_strict`, performances that cannot be used are left out instead, and so are moves
/// without a usable right performance. Fails if no move remains.
Result<std::vector<TaughtMove>> TeachMoves(const std::vector<NamedStream>& streams,
                                           const std::vector<LabelledPart>& parts,
                                           const std::function<bool(const LabelledPart&)>& takes, bool is_strict);

/// Returns the performances that TeachMoves learns from, in the order of the parts, as PerformancesOf cuts them.
std::vector<LabelledPart> PerformancesToLearn(const std::vector<NamedStream>& streams,
                                              const std::vector<LabelledPart>& parts,
                                              const std::function<bool(const LabelledPart&)>& takes, bool is_strict);

/// Returns the parts, with each action point replaced by a performance as TeachMoves describes; other parts are
/// unchanged.
std::vector<LabelledPart> PerformancesOf(const std::vector<LabelledPart>& parts,
                                         const std::vector<NamedStream>& streams);

}  // namespace etude
