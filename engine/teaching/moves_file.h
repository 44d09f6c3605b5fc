#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// Writes taught moves as YAML (docs/streams.md, "A moves file"), for every recogniser: key poses as choreography files
/// have them, performances as lines of millimetres with a letter a joint.
///
///     moves:
///       - name: arms-open
///         span_s: 3.2
///         key_poses:
///           - {tolerance_deg: 20, RH: 57, LH: {degrees: 57, tolerance_deg: 25}}
///         right:
///           - rate_hz: 30
///             frames: |
///               tttttttttttttttttttt 0 950 0 0 1150 …
///         wrong: []
std::string WriteMoves(const std::vector<TaughtMove>& moves);

/// Reads them back: positions to a tenth of a millimetre, everything else as it was written. Refused with file, line
/// and column: unknown keys and features, tolerances of 0, frames of another number of values, two moves of one name,
/// more than 64 MiB.
Result<std::vector<TaughtMove>> ReadMoves(std::string_view text, const std::string& file);

}  // namespace etude
