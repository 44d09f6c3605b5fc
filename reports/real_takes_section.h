#pragma once

#include <span>
#include <string>

#include "bench/model/run_data.h"
#include "bench/real_takes/real_take.h"

namespace etude {

/// Captures of real films beside the simulated takes of a run, as a section of its page; "" when there are none.
std::string RealTakesSection(const RunData& run, std::span<const RealTake> takes);

}  // namespace etude
