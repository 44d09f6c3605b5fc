#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/junit.h"

namespace etude {

/// Returns the section of faulty clips, for scenarios whose motions have no ground truth. Clips that exceed their fault
/// limits come first; each fault is described in words. Returns "" for other runs.
std::string FaultyClipsSection(const RunData& run);

/// Returns the table of FaultyClipsSection as Markdown, under a heading. Returns "" for other runs.
std::string FaultyClipsMarkdown(const RunData& run);

/// Returns one JUnit case for every clip of a scenario whose motions have no ground truth. A case fails if its clip
/// exceeds the fault limits or cannot be judged; otherwise the case lists the clip's faults.
std::vector<JunitCase> ClipCases(const RunData& run, const std::string& scenario);

}  // namespace etude
