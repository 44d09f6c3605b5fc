#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/recogniser.h"
#include "engine/recognition/sight.h"

namespace etude {

/// A half-open interval [begin, end) of a stream's frames.
struct FrameInterval {
  int begin = 0;
  int end = 0;  ///< not below `begin`
};

/// Returns the frames of `stream` that overlap the interval from `start_s` to `end_s`, in seconds from the stream's
/// first frame, clamped to the stream.
FrameInterval FramesBetween(double start_s, double end_s, const SkeletonStream& stream);

/// A requested performance: the move, and the window in which it is expected.
struct AskedMove {
  std::size_t move = 0;  ///< the taught move's index
  FrameInterval window;
};

/// A recogniser's evidence in every frame of a stream.
struct EvidenceTrace {
  std::size_t moves = 0;
  std::vector<double> asked;    ///< evidence of the asked move, per frame
  std::vector<double> spotted;  ///< evidence of every move in every frame; the moves of one frame are adjacent

  /// Returns the evidence of every move in a frame.
  std::span<const double> SpottedAt(std::size_t frame) const {
    return std::span(spotted).subspan(frame * moves, moves);
  }
};

/// Follows the whole stream as if it were live, and asks for each move when its window opens. `asked` must be in order
/// of time, within the stream and without overlap; an error names the first entry that is not. `moves` is the number of
/// taught moves.
Result<EvidenceTrace> FollowStream(const Recogniser& recogniser, std::size_t moves, const SeenStream& seen,
                                   std::span<const AskedMove> asked);

/// The options by which evidence becomes decisions.
struct DecisionOptions {
  /// The evidence at which a move counts as performed, in (0, 1]. Choose it on recordings of other people than the
  /// people who are to be judged: low enough to detect moves, and high enough to make false alarms acceptably rare.
  double threshold = 0.5;
  /// The time after a detection in which the same move is not detected again, in seconds, ≥ 0. It keeps a performance
  /// with flickering evidence from being detected twice.
  double refractory_s = 1.0;
};

/// The result for one performance that was asked for.
struct Judgement {
  std::optional<int>
      recognised_at;  ///< frame counted from the window's beginning; nullopt if the move was not recognised
  double score = 0;   ///< score for ROC curves, in [0, 1]
  std::vector<double> running_score;  ///< evidence of the asked move in each frame of the window
};

/// Judges one window of the trace. Its move must have been asked for in this window.
Judgement JudgeWindow(const EvidenceTrace& trace, const FrameInterval& window, double threshold);

/// Turns evidence into detections frame by frame, separately for each move. A move is detected when its evidence
/// reaches the threshold. It can be detected again after the evidence fell below the threshold and the refractory time
/// has passed. The time without a body changes nothing: evidence that only the loss of the body lowered is not taken as
/// fallen.
class MoveSpotter {
 public:
  MoveSpotter(std::size_t moves, const DecisionOptions& options, double rate_hz);

  /// Returns the moves detected in this frame, in index order. The span is valid until the next call. `body_seen` is
  /// false for a frame without a body.
  std::span<const std::size_t> Update(std::span<const double> spotted, bool body_seen = true);

 private:
  struct State {
    bool is_above = false;
    int silent_until = 0;
  };
  double threshold_;
  int refractory_frames_, step_frames_;
  int frame_ = 0, renewed_at_ = 0;
  std::vector<State> states_;
  std::vector<std::size_t> fired_;
};

struct Detection {
  std::size_t move = 0;
  int frame = 0;
};

/// Returns all detections of all moves in the stream, sorted by move and then by time. A detection outside of a
/// performance of its move is a false alarm; finding these needs the ground truth.
std::vector<Detection> FindMoves(const EvidenceTrace& trace, double rate_hz, const DecisionOptions& options);

}  // namespace etude
