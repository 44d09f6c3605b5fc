#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/taught_move.h"

namespace etude {

/// Writes taught moves as YAML (docs/streams.md, "A moves file") for every recogniser: key poses as in choreography
/// files, performances as lines with one letter per joint and coordinates in millimetres.
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

/// Reads the output of WriteMoves: positions to 0.1 mm, everything else exactly. Fails, with file, line and column, for
/// unknown keys and features, tolerances of 0, frames with a wrong number of values, two moves with the same name, and
/// more than 64 MiB.
Result<std::vector<TaughtMove>> ReadMoves(std::string_view text, const std::string& file);

}  // namespace etude
