#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/taught_move.h"
#include "engine/teaching/labelled_streams.h"

namespace etude {

/// Returns true if all joints of two streams move equally (AreEqual).
bool ShowSameMotion(const SkeletonStream& a, const SkeletonStream& b);

/// Leaves out each recording that shows the same motion as another one (AreEqual), such as a copy or another format of
/// it, so that the motion counts once. Removes it from `streams`, and its performances from `parts`; the indices in
/// `parts` are updated. Returns the recordings that were left out, with the reason. Fails, naming both recordings, if
/// they name two people or if they have other performances.
Result<std::vector<Error>> LeaveOutCopies(std::vector<NamedStream>& streams, std::vector<LabelledPart>& parts);

/// Returns how many of the performances show the same motion as an example that one of the moves was taught with, right
/// or wrong.
std::size_t CountTaught(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                        std::span<const TaughtMove> moves);

}  // namespace etude
