#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/sight.h"

namespace etude {

/// The frames [begin, end) of a stream.
struct FrameInterval {
  int begin = 0;
  int end = 0;  ///< ≥ begin
};

/// The frames of `stream` that touch the interval from `start_s` to `end_s`, seconds from the stream's first frame;
/// what lies outside the stream is cut off.
FrameInterval FramesBetween(double start_s, double end_s, const SkeletonStream& stream);

/// A performance that was asked for: which move is to be recognised, and when.
struct AskedMove {
  std::size_t move = 0;  ///< the taught move's index
  FrameInterval window;
};

/// A recogniser's evidence in every frame of a stream.
struct EvidenceTrace {
  std::size_t moves = 0;
  std::vector<double> asked;    ///< per frame
  std::vector<double> spotted;  ///< per frame and move, frame by frame

  std::span<const double> SpottedAt(std::size_t frame) const {
    return std::span(spotted).subspan(frame * moves, moves);
  }
};

/// Follows the whole stream, as live: asks for each move when its window opens. `asked`: in order of time, within the
/// stream, none overlapping another; `moves`: how many the recogniser was taught.
Result<EvidenceTrace> FollowStream(const Recogniser& recogniser, std::size_t moves, const SeenStream& seen,
                                   std::span<const AskedMove> asked);

/// The options by which evidence becomes decisions.
struct DecisionOptions {
  /// The evidence from which on a move counts as performed, in (0, 1]. Set it on people who are not judged, to the
  /// false alarms that one can bear.
  double threshold = 0.5;
  /// A move that was spotted is not spotted again for so long, seconds, ≥ 0: a performance is one detection, however
  /// its evidence flickers.
  double refractory_s = 1.0;
};

/// The coach's conclusion about one performance that it asked for.
struct Judgement {
  std::optional<int> recognised_at;   ///< frame within the window; empty: the move was not recognised
  double score = 0;                   ///< in [0, 1], for ROC curves
  std::vector<double> running_score;  ///< per frame of the window
};

/// Judges one window of the trace, in which its move was asked for.
Judgement JudgeWindow(const EvidenceTrace& trace, const FrameInterval& window, double threshold);

/// Turns evidence into detections, frame by frame, each move for itself: it is spotted when its evidence rises to the
/// threshold, and not again before it fell below and the refractory time is over.
class MoveSpotter {
 public:
  MoveSpotter(std::size_t moves, const DecisionOptions& options, double rate_hz);

  /// The moves spotted in this frame, in their order. Valid until the next call.
  std::span<const std::size_t> Update(std::span<const double> spotted);

 private:
  struct State {
    bool is_above = false;
    int silent_until = 0;
  };
  double threshold_;
  int refractory_frames_;
  int frame_ = 0;
  std::vector<State> states_;
  std::vector<std::size_t> fired_;
};

/// A recogniser took a move for performed.
struct Detection {
  std::size_t move = 0;  ///< its index
  int frame = 0;
};

/// Every time that a move was spotted in the stream, asked for or not: by move, then by time. Those in no performance
/// of their move are false alarms, which only someone who knows what was performed can tell.
std::vector<Detection> FindMoves(const EvidenceTrace& trace, double rate_hz, const DecisionOptions& options);

}  // namespace etude
