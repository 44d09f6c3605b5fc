#pragma once

#include <span>

#include "bench/streams/load.h"
#include "sim/performer/fault.h"

namespace etude {

/// The faults that can be made of the recording of somebody who is right: amplitude, wrong side, wrong move.
std::span<const Fault> MadeFaults();

/// Returns the recording as it would be with the fault: every limb half-way between where it points in the first frame
/// with a body and where it points now, each as long as it is; left and right exchanged; as it is, for somebody who
/// was asked for another move. `fault` is one of MadeFaults.
NamedStream WithFault(const NamedStream& right, Fault fault);

/// Says what a right performance of a recording became with this fault, by the same limits as among simulated people
/// (StrayLimits): by the angles of the limb that strays farthest; where sides are exchanged, the performances are laid
/// on each other in time first (dynamic time warping), so that a step more of a walk is none. Another move is wrong.
Truth TruthOfFault(const NamedStream& right, const NamedStream& faulty, const LabelledPart& part, Fault fault);

}  // namespace etude
