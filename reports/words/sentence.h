#pragma once

#include <string>
#include <vector>

#include "reports/words/judged.h"

namespace etude {

/// How a method did against another, over all its conditions, in a sentence with the figures that carry it. The
/// verdict it names is the one on these worlds, and it says so. `judged` must not be empty.
std::string SentenceOf(const std::vector<Judged>& judged, SamplingUnit unit);

}  // namespace etude
