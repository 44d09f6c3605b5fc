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

namespace etude {

/// Makes the world of one person: their recordings, one after another, with their labels. Clips are sensed as the
/// condition says; recordings of a sensor are used as they are. A performance is judged until half a second after its
/// end, but at most until the next one begins; this also holds for labels that overlap. If the condition names faults,
/// each recording follows once more with each fault; right performances are then judged by TruthOfFault, and
/// performances that were wrong before are grey.
DetectionWorld MakeRecordedWorld(const LabelledStreams& set, std::size_t person, const DetectionOptions& options,
                                 const WorldKey& key);

/// Complains of labels that cannot be judged: two performances that begin at the same frame, and, without taught moves
/// (`are_taught`), a single person, or recordings whose person is unknown.
Result<void> CheckRecordings(const LabelledStreams& set, bool are_taught);

/// What recognisers were taught, with some people left out.
struct Fold {
  Repertoire repertoire;
  std::vector<ReadyMethod> methods;
};

/// Teaches the methods' recognisers: `taught`, if given; otherwise all moves by everybody except `left_out`, with right
/// performances as examples and wrong ones as counter-examples. A move that nobody else did right stays untaught. Fails
/// if no move is left, or if a method needs more examples of a move than there are.
Result<Fold> MakeFold(const LabelledStreams& set, const std::optional<std::vector<TaughtMove>>& taught,
                      const std::set<std::string>& left_out, const std::vector<DetectionMethod>& methods);

/// Makes a task whose worlds are recorded people, one per trial in the order of their names. Recognisers are taught the
/// moves of the file that the condition names, or else the performances of all other people. The task keeps the set's
/// address.
Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods);

}  // namespace etude
