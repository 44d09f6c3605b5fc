#pragma once

#include <optional>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/streams/level.h"
#include "engine/streams/recording.h"

namespace etude {

struct StreamOptions {
  bool levels = true;     ///< estimate gravity and floor of files that do not say; else take the file's
  bool reflects = false;  ///< negate X: of files whose X axis runs the other way, so that bodies are mirrored
  double rate_hz = kJudgedRateHz;
};

/// Makes an even stream of recorded frames as they come, causally: frame k is at k / rate_hz seconds after the first
/// one. Between two recorded frames at most 0.2 s apart joints go straight; over a longer gap the body is lost. A joint
/// that is not reported stays where it was last, not tracked, as a Kinect has it; before its first report it is at its
/// parent's place. A frame within half a millisecond of a recorded one is that one, unchanged.
class StreamMaker {
 public:
  StreamMaker(const StreamLevel& level, const StreamOptions& options, std::string file);

  /// Takes the next recorded frame; appends those of the stream that are known by it. Refused, naming its line: a clock
  /// that runs backwards or stands still for over ten minutes.
  Result<void> Add(const RecordedFrame& frame, std::vector<SensedFrame>& stream);

 private:
  SensedFrame Sensed(const RecordedFrame& frame);

  StreamLevel level_;
  StreamOptions options_;
  std::string file_;
  std::optional<RecordedFrame> before_;
  double start_s_ = 0;
  std::size_t next_ = 0;  // the frame of the stream that comes next
  std::array<std::optional<glm::dvec3>, kRoleCount> last_;
};

/// What became of a recording.
struct MadeStream {
  SkeletonStream stream;
  StreamLevel level;
  double start_s = 0;           ///< the first frame's time by the file's own clock
  std::size_t lost_frames = 0;  ///< of the stream, in which nobody was seen
};

/// The stream of a whole recording: level by all of it.
Result<MadeStream> MakeStream(const StreamRecording& recording, const std::string& file,
                              const StreamOptions& options = {});

/// Whether feet point where the body faces, which left and right tell: straight ahead +1, in the mean over the frames
/// that show them; backwards −1, as in a mirrored recording. Nothing where no foot was seen.
std::optional<double> FeetForward(const SkeletonStream& stream);

}  // namespace etude
