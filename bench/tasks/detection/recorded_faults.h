#pragma once

#include <span>

#include "engine/teaching/labelled_streams.h"
#include "sim/performer/fault.h"

namespace etude {

/// Returns the faults that can be imposed on the recording of a right performance: amplitude, wrong side, wrong move.
std::span<const Fault> MadeFaults();

/// Returns the recording with the fault imposed. Amplitude: every limb points half-way between its direction in the
/// first frame with a body and its present direction; lengths do not change. Wrong side: left and right are exchanged.
/// Wrong move: unchanged, for a person who was asked for another move. `fault` is one of MadeFaults.
NamedStream WithFault(const NamedStream& right, Fault fault);

/// Returns whether a right performance is still right, grey or wrong with this fault. The limits are those for
/// simulated people (StrayLimits), applied to the angles of the limb that deviates most. For a wrong side, dynamic time
/// warping first aligns the performances in time, so that an additional step of a walk does not count. A wrong move is
/// always wrong.
Truth TruthOfFault(const NamedStream& right, const NamedStream& faulty, const LabelledPart& part, Fault fault);

}  // namespace etude
