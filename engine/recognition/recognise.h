#pragma once

#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/key_pose.h"

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
  std::string name;  ///< of one of RecognitionInput::taught
  FrameInterval window;
};

/// A stream as recognisers behind the same filter see it: computed once for all of them.
struct SeenStream {
  SkeletonStream filtered;
  std::vector<FeatureFrame> frames;  ///< one per frame of the stream
};

/// Filters the stream and reads the pose features off it, by the hip height that the performer has in the filtered
/// stream.
SeenStream SeeStream(const SkeletonStream& stream, const FilterOptions& filter);

/// What recognition works on; all of it must outlive the call.
struct RecognitionInput {
  const SeenStream& seen;
  std::span<const AskedMove> asked;    ///< windows within the stream; they may overlap
  std::span<const TaughtMove> taught;  ///< every move that may be performed, names all different
};

/// A recogniser took a move for performed.
struct Detection {
  std::string move;
  int frame = 0;  ///< of the stream, the one in which the last key pose had been held long enough
};

struct Recognition {
  /// One per move asked for, in that order; frames count from its window's first.
  std::vector<Judgement> judgements;
  /// Everything the recognisers of all moves saw when they ran through the whole stream, asked for or not: by move in
  /// the order of `taught`, then by time. Those in no performance of their move are false alarms, which only someone
  /// who knows what was performed can tell.
  std::vector<Detection> detections;
};

/// Paper A's recognition (algorithms A7): judges every performance asked for in its window, and looks for every move in
/// the whole stream. Refuses a move asked for that was not taught, a window that is not within the stream, and options
/// or key poses outside their ranges.
///
///     const SeenStream seen = SeeStream(stream, {.kind = FilterKind::kHolt});
///     const auto found = Recognise({.seen = seen, .asked = asked, .taught = taught}, {.threshold = 0.8});
Result<Recognition> Recognise(const RecognitionInput& input, const KeyPoseOptions& options);

}  // namespace etude
