#pragma once

#include <optional>
#include <string>

#include "engine/base/result.h"
#include "engine/motion/clip.h"

namespace etude {

/// A part of a clip, seconds from its first frame.
struct TimeSpan {
  double from_s = 0;
  double to_s = 0;
};
/// "1.5:4"; either end may be left out. Refused: anything else, an end before its start.
Result<TimeSpan> ParseTimeSpan(const std::string& text);

/// The part of a clip; all of it without one. An open end is the clip's.
Result<Clip> TrimTo(const Clip& clip, const std::optional<TimeSpan>& span);

}  // namespace etude
