#pragma once

#include <span>
#include <string>

#include "bench/model/run_data.h"
#include "bench/real_takes/real_take.h"
#include "reports/films/media.h"

namespace etude {

/// Writes the page that shows a run to people: verdict first, plain words, pictures; numbers folded away. It holds
/// everything it needs, and forbids itself the network. `real`: captures of real films, shown beside the simulated
/// ones.
std::string WritePage(const RunData& run, const Media& media, std::span<const RealTake> real = {});

}  // namespace etude
