#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/junit.h"

namespace etude {

/// Returns the section with the clips of motions without a truth that show faults, those beyond their limits first,
/// with each fault in words; "" for other runs.
std::string FaultyClipsSection(const RunData& run);

/// Returns the same table for Markdown, under a heading; "" for other runs.
std::string FaultyClipsMarkdown(const RunData& run);

/// Returns a case for every clip of a scenario of motions without a truth: it fails if the clip exceeds its limits or
/// cannot be judged; otherwise it says what faults the clip shows.
std::vector<JunitCase> ClipCases(const RunData& run, const std::string& scenario);

}  // namespace etude
