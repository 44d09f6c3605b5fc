#pragma once

#include <string>

#include "bench/model/run_data.h"
#include "reports/films/media.h"

namespace etude {

/// The page that shows a run to people: verdict first, plain words, pictures; numbers folded away. It
/// holds everything it needs, and forbids itself the network.
std::string WritePage(const RunData& run, const Media& media);

}  // namespace etude
