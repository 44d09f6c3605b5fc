#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// Returns a small invented run: four scenarios with the questions of `scenarios/quick`, plausible figures, all
/// verdicts, failures with reasons, missing values, curves, and hostile names. It has no recordings.
RunData ExampleRun();

/// Adds the recordings that films need: a coach that changes from one arm move to another, and a capture by two cameras
/// whose recovered skeleton is slightly off.
void AddRecordings(RunData& run);

/// Adds recordings of one request of the scenario "transition" under three methods, with all that explains a
/// transition: "now" cuts, "fuzzy-bridge" goes through an in-between, "gate-inertialised" takes its best candidate.
void AddTransitions(RunData& run);

}  // namespace etude
