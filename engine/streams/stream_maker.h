#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/streams/recording.h"

namespace etude {

/// The transform from a recording's space to the world, in which Y points up and the floor is at 0; X and Z are not
/// shifted.
struct StreamLevel {
  enum class By { kNothing, kFeet, kTrunk };

  glm::dmat3 R_WF{1};       ///< rotates the file's directions into the world; about a horizontal axis only
  double floor_m = 0;       ///< height of the floor after that rotation
  double tilt_deg = 0;      ///< of that rotation
  By up_by = By::kNothing;  ///< what told where up is

  glm::dvec3 Apply(const glm::dvec3& place) const { return R_WF * place - glm::dvec3(0, floor_m, 0); }
};

/// Finds gravity and floor from the body alone, because few files tell how their sensor was tilted (ours). Up is the
/// normal of the plane under feet that stand, where they stood far enough apart to tell it (the deviation 10 cm both
/// ways, 3 cm off the plane at most, and within 15° of the trunk's); else the trunk's middle direction, which takes a
/// constant lean for a tilt. Neither: within 30° of the file's own up, or nothing is rotated. The floor is where the
/// lower foot mostly is: its 10th percentile. `rate_hz` > 0, of the frames.
StreamLevel EstimateLevel(std::span<const RecordedFrame> frames, double rate_hz);

/// Describes a level as "level by trunk: turned by 6.3 degrees, floor 0.83 m below".
std::string Describe(const StreamLevel& level);

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

/// The stream of a recording.
struct MadeStream {
  SkeletonStream stream;
  StreamLevel level;
  double start_s = 0;           ///< the first frame's time by the file's own clock
  std::size_t lost_frames = 0;  ///< of the stream, in which nobody was seen
};

/// Makes the stream of a whole recording, levelled by all of it.
Result<MadeStream> MakeStream(const StreamRecording& recording, const std::string& file,
                              const StreamOptions& options = {});

/// Returns how far feet point where the body faces by its left and right, as a mean over the frames that show them: +1
/// is straight ahead, −1 backwards as in a mirrored recording. Nothing when no foot was seen.
std::optional<double> FeetForward(const SkeletonStream& stream);

}  // namespace etude
