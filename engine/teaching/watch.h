#pragma once

#include <memory>
#include <vector>

#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"

namespace etude {

/// The options for watching streams.
struct WatchOptions {
  RecogniserOptions recogniser;
  FilterOptions filter;
  DecisionOptions decision;
};

/// A move that was spotted in a stream.
struct Spotting {
  std::size_t move = 0;
  int frame = 0;
  double evidence = 0;
};

/// Follows a stream frame by frame, live or recorded, and spots moves. `recogniser` must outlive this object.
class StreamWatcher {
 public:
  StreamWatcher(const Recogniser& recogniser, std::size_t moves, const WatchOptions& options, double rate_hz);

  /// Takes the next frame and returns the moves spotted in it.
  std::vector<Spotting> Take(const SensedFrame& frame);

 private:
  LiveSight sight_;
  std::unique_ptr<MoveFollower> follower_;
  MoveSpotter spotter_;
  int frame_ = 0;
};

/// Watches a whole recorded stream.
std::vector<Spotting> Watch(const SkeletonStream& stream, const Recogniser& recogniser, std::size_t moves,
                            const WatchOptions& options);

/// Returns the move that the frames [begin, end) most likely show: the answer of MoveFollower::Whole for these frames
/// or, without an answer, the move whose evidence becomes highest in these frames. Other frames do not count. Returns
/// nullopt if no move has evidence.
std::optional<std::size_t> Classify(const SeenStream& seen, int begin, int end, const Recogniser& recogniser,
                                    std::size_t moves);

/// Judges the frames [begin, end) as a performance of `move`, which is asked for in frame `begin`. Returns the evidence
/// that the performance is right, in [0, 1] (Evidence::asked).
double JudgeAsked(const SeenStream& seen, int begin, int end, const Recogniser& recogniser, std::size_t move);

}  // namespace etude
