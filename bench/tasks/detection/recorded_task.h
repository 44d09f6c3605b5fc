#pragma once

#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/operating_point.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"
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

/// The recordings of one person, one recording after another, with what its labels say. Clips are sensed
/// under the condition; a sensor's recordings are what they are. A performance is judged until half a second after its
/// end, but not beyond the next one's beginning; where labels overlap, the earlier is judged as far as that. Where the
/// condition names faults, each recording follows once more with each of them, in which what was right
/// is wrong; what the fault hardly changes, and what had been wrong, is grey there.
DetectionWorld MakeRecordedWorld(const LabelledStreams& set, std::size_t person, const DetectionOptions& options,
                                 const WorldKey& key);

/// Refuses labels by which nothing can be judged: two performances that begin at once, and, without `are_taught`, one
/// person, or recordings of which nobody says who they show.
Result<void> CheckRecordings(const LabelledStreams& set, bool are_taught);

/// The knowledge of recognisers when people are left out: what the others did.
struct Fold {
  Repertoire repertoire;
  std::vector<ReadyMethod> methods;
};

/// `taught`: by whom and whatever; nothing: all moves by everybody but those left out, right performances as examples
/// and wrong ones as counter-examples. A move that nobody else did right stays untaught. Fails when there is none, and
/// where a method needs more of a move than it has.
Result<Fold> MakeFold(const LabelledStreams& set, const std::optional<std::vector<TaughtMove>>& taught,
                      const std::set<std::string>& left_out, const std::vector<DetectionMethod>& methods);

/// A task whose worlds are recorded people, a trial each by their names' order: judged by what the file of taught moves
/// says that the condition names, else by what all others did. The task keeps the set's address.
Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods);

}  // namespace etude
