#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/clips/convert.h"
#include "bench/clips/open_clip.h"
#include "cli/clip_commands.h"
#include "engine/base/result.h"
#include "engine/fuzzy/fuzzy_system.h"

namespace etude {

/// --joint-map, --unit and --up.
Result<OpenOptions> ReadOptions(const ClipReading& reading);

/// --trim; nothing without it.
Result<std::optional<TimeSpan>> ReadTrim(const std::string& text);

/// What all references stand for, in order.
Result<std::vector<std::string>> ExpandAll(const std::vector<std::string>& references);

/// --fuzzy: builtin:NAME or a file; "" = paper A's.
Result<FuzzySystem> ReadFuzzy(const std::string& reference);

}  // namespace etude
