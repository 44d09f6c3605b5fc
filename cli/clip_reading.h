#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"
#include "io/clips/convert.h"
#include "io/clips/open_clip.h"

namespace CLI {
class App;
}

namespace etude {

/// The facts about files that cannot tell them themselves; "" = found out.
struct ClipReading {
  std::string joint_map;  ///< a joint-map file
  std::string unit;       ///< "m", "cm", … or metres per unit as a number
  std::string up;         ///< "y" or "z"
  std::optional<double> rate_hz = {};
};

/// Adds --joint-map, --unit and --up, of every command that opens clips by themselves, and the rate of files under the
/// name `rate`; no option of it where that is "".
void AddClipReading(CLI::App& command, ClipReading& reading, const std::string& rate = "--rate");

/// Reads these options.
Result<OpenOptions> ReadOptions(const ClipReading& reading);

/// Reads --trim; nothing without it.
Result<std::optional<TimeSpan>> ReadTrim(const std::string& text);

/// Reads --fuzzy: builtin:NAME or a file; "" is paper A's system.
Result<FuzzySystem> ReadFuzzy(const std::string& reference);

}  // namespace etude
