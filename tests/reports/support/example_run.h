#pragma once

#include "bench/model/run_data.h"

namespace etude {

/// A small hand-made run: four scenarios as `scenarios/quick` asks them, with plausible figures, all
/// verdicts, failures with reasons, missing values, curves, and hostile names. Nothing is recorded.
RunData ExampleRun();

/// Adds what a film needs: a coach stepping from one arm move to another, and a capture by two cameras
/// whose recovered skeleton is slightly off.
void AddRecordings(RunData& run);

/// Adds one request of the scenario "transition" as three methods recorded it, with everything that explains a
/// transition: "now" cuts, "fuzzy-bridge" goes through an in-between, "gate-inertialised" takes the best of its
/// candidates.
void AddTransitions(RunData& run);

}  // namespace etude
