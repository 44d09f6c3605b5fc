#pragma once

#include <string>

#include "engine/base/result.h"
#include "engine/coaching/coach.h"

namespace etude {

/// The first line that `etude coach` writes: the song, its moves with their hints and key poses, the order of joints.
Result<std::string> CoachHead(const Dance& dance);

/// One frame as a line of JSON (docs/coach.md). Metres, to the millimetre; without the body when `brief`.
Result<std::string> CoachLine(const CoachOutput& output, std::int64_t frame, const Dance& dance, bool brief);

}  // namespace etude
