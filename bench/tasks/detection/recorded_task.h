#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "bench/tasks/base/task.h"
#include "bench/tasks/detection/operating_point.h"
#include "bench/tasks/detection/options.h"
#include "bench/tasks/detection/world.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"

namespace etude {

/// Makes the world of one person: their recordings, one after another, with their labels. Clips are sensed by the
/// condition's sensor; recordings of a sensor are used unchanged. The window of a performance ends half a second after
/// the performance, or at the beginning of the next one if that is earlier; this also holds for labels that overlap. If
/// the condition names faults, each recording is followed by one copy with each fault. In a copy, a performance that
/// was right has the truth that TruthOfFault returns; one that was already wrong is grey, so it is not scored.
DetectionWorld MakeRecordedWorld(const LabelledStreams& set, std::size_t person, const DetectionOptions& options,
                                 const WorldKey& key);

/// Fails if labels cannot be judged: if two performances of a recording begin at the same frame. If `are_taught` is
/// false, moves are learnt from other people; then it also fails for a single person, and for unknown people.
Result<void> CheckRecordings(const LabelledStreams& set, bool are_taught);

/// The moves that recognisers were taught, and the methods with these recognisers. The recordings of some people may
/// have been left out when the moves were taught.
struct Fold {
  Repertoire repertoire;
  std::vector<ReadyMethod> methods;
};

/// Teaches the methods' recognisers. If `taught` is given, they are taught these moves. Otherwise all people except
/// `left_out` teach them all moves, with right performances as examples and wrong ones as counter-examples. A move that
/// nobody else performed right stays untaught. Fails if no move is left, or if a method needs more examples of a move
/// than there are.
Result<Fold> MakeFold(const LabelledStreams& set, const std::optional<std::vector<TaughtMove>>& taught,
                      const std::set<std::string>& left_out, const std::vector<DetectionMethod>& methods);

/// Makes a task whose worlds are recorded people, one per trial, in the order of their names. Recognisers are taught
/// the moves in the file that the condition names or, without such a file, the performances of all other people. The
/// recordings in `input` must outlive the task.
Result<std::unique_ptr<Task>> MakeRecordedTask(TaskInput& input, const DetectionOptions& options,
                                               std::vector<DetectionMethod> methods);

}  // namespace etude
