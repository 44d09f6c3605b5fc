#pragma once

#include <memory>
#include <string>
#include <vector>

#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"
#include "engine/teaching/labelled_streams.h"

namespace etude {

/// The options with which streams are watched.
struct WatchOptions {
  RecogniserOptions recogniser;
  FilterOptions filter;
  DecisionOptions decision;
};

/// A move that was spotted.
struct Spotting {
  std::size_t move = 0;
  int frame = 0;
  double evidence = 0;
};

/// Follows a stream frame by frame, live or recorded, and spots moves. `recogniser` must outlive this.
class StreamWatcher {
 public:
  StreamWatcher(const Recogniser& recogniser, std::size_t moves, const WatchOptions& options, double rate_hz);

  /// Takes the next frame and returns what was spotted in it.
  std::vector<Spotting> Take(const SensedFrame& frame);

 private:
  LiveSight sight_;
  std::unique_ptr<MoveFollower> follower_;
  MoveSpotter spotter_;
  int frame_ = 0;
};

/// Watches all of a recorded stream.
std::vector<Spotting> Watch(const SkeletonStream& stream, const Recogniser& recogniser, std::size_t moves,
                            const WatchOptions& options);

/// Finds the move that the frames [begin, end) most likely show: the one whose evidence becomes highest in them,
/// without regard to other frames. Returns nothing if no move has evidence.
std::optional<std::size_t> Classify(const SeenStream& seen, int begin, int end, const Recogniser& recogniser,
                                    std::size_t moves);

/// Returns how right the move looks if it is asked for in the frames [begin, end), in [0, 1].
double JudgeAsked(const SeenStream& seen, int begin, int end, const Recogniser& recogniser, std::size_t move);

}  // namespace etude
