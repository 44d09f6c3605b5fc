#pragma once

#include <span>

#include "engine/teaching/labelled_streams.h"
#include "sim/performer/fault.h"

namespace etude {

/// Returns the faults that can be imposed on a recording of a right performance: amplitude, wrong side, wrong move.
std::span<const Fault> MadeFaults();

/// Returns a copy of a recording with a fault imposed. Amplitude: in each frame, every limb points half-way between
/// its direction in the first frame with a body and its own direction in that frame; lengths do not change. Wrong
/// side: left and right are exchanged. Wrong move: the recording is unchanged, but another move counts as requested.
/// `fault` must be one of MadeFaults.
NamedStream WithFault(const NamedStream& right, Fault fault);

/// Returns the truth about a right performance after this fault: still right, grey or wrong. The limits are those for
/// simulated people (DeviationLimits), applied to the angles of the limb that deviates most. For a wrong side, dynamic
/// time warping first aligns the performances in time, so that an additional step of a walk does not count. After
/// `Fault::kWrongMove`, the truth is always wrong.
Truth TruthOfFault(const NamedStream& right, const NamedStream& faulty, const LabelledPart& part, Fault fault);

}  // namespace etude
