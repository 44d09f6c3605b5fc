#pragma once

#include <string>

#include "bench/model/summary.h"

namespace etude {

/// What leaving one unit out does to a comparison, in words: the range, the unit that matters most, and whether it alone
/// carries the difference, or hides one. "" where worlds are units.
std::string WithoutEachUnit(const Comparison& comparison, SamplingUnit unit);

/// The same as a strip: the mean difference without each unit, against what matters; words beneath.
std::string LeftOutStripHtml(const Comparison& comparison, SamplingUnit unit);

}  // namespace etude
