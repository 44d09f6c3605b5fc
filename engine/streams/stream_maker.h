#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/recognition/skeleton_stream.h"
#include "engine/retargeting/leg_sides.h"
#include "engine/retargeting/orientation.h"
#include "engine/streams/recording.h"

namespace etude {

/// The transform from a recording's space to the world, whose Y axis points up and whose floor is at height 0. X and Z
/// are not shifted.
struct StreamLevel {
  enum class By { kNothing, kFeet, kTrunk };

  glm::dmat3 R_WF{1};       ///< rotates the file's directions into the world: first by turn_deg, then by tilt_deg
  double floor_m = 0;       ///< height of the floor after the rotation by `R_WF`, metres
  int turn_deg = 0;         ///< turn of a sensor in portrait or upside down, about its line of sight: 0, 90, 180, 270
  double tilt_deg = 0;      ///< angle of the rotation about a horizontal axis
  By up_by = By::kNothing;  ///< the evidence for the up direction
  /// The angle between the trunk and the file's up direction, degrees, if this direction was kept although the trunk
  /// contradicts it; otherwise 0.
  double trunk_deg = 0;

  glm::dvec3 Apply(const glm::dvec3& place) const { return R_WF * place - glm::dvec3(0, floor_m, 0); }
};

/// Estimates gravity and floor from the body alone, because few files contain the tilt of their sensor (ours). Up is
/// the normal of the plane under standing feet if the feet determine the plane: their positions have a standard
/// deviation of at least 10 cm in both horizontal directions and of at most 3 cm from the plane, and the normal is
/// within 15° of the trunk. Otherwise up is the trunk's median direction, so a constant lean counts as a tilt of the
/// sensor. If the person squats or bows, only the frames count in which the person stands tall. If the result is more
/// than 30° from the file's own up, nothing is rotated. If the sensor was mounted in portrait or upside down, the
/// frames are first rotated upright, by quarter turns about the line of sight. Such a sensor is recognised by the
/// trunk: in seven of ten frames the trunk is within 30° of another axis of the file, and hardly ever near the file's
/// up axis. In portrait, the body must also face the sensor, or away from it, in the median frame; a body that lies in
/// front of an upright sensor usually faces up or down. The floor is the 10th percentile of the lower foot's height.
/// `rate_hz` > 0 is the frames' rate.
StreamLevel EstimateLevel(std::span<const RecordedFrame> frames, double rate_hz);

/// Returns "without a clock (Etude assumes 30 Hz)" for a recording without times; otherwise "".
std::string DescribeAssumedRate(const StreamRecording& recording);

/// Describes a level for users: "up by the trunk (6.3 degrees), floor 0.83 m below the sensor". Also mentions a sensor
/// in portrait or upside down, and a trunk that is far from the file's up.
std::string Describe(const StreamLevel& level);

struct StreamOptions {
  bool levels = true;     ///< true: estimate gravity and floor if the file does not define them; false: keep the file's
  bool reflects = false;  ///< true: X is negated, for files whose X axis points the other way and mirrors bodies
  double rate_hz = kJudgedRateHz;
  /// The axis of the file that points up, for formats that state the axis (StreamRecording::is_level); nullopt: Y.
  std::optional<UpAxis> up = {};
};

/// Returns the level of a recording: by the convention of its format (StreamRecording::is_level) and StreamOptions::up;
/// otherwise estimated from its frames, unless StreamOptions::levels forbids it.
StreamLevel LevelOf(const StreamRecording& recording, const StreamOptions& options);

/// The rule about StreamOptions::up, as the end of a message to users.
inline constexpr const char* kWhereUpIsAllowed =
    "allowed only for clips and for recordings in CSV or TRC, but this is a recording of a sensor, whose up axis Etude "
    "estimates (--level)";

/// Resamples recorded frames online to a constant rate: frame k is k / rate_hz seconds after the first frame. Between
/// two recorded frames at most 0.2 s apart, joints are interpolated linearly; over a longer gap the body is lost. A
/// joint that is not reported keeps its last position with the state "not tracked", as on a Kinect; before its first
/// report it is at its parent's position. A recorded frame within half a millisecond of a stream's frame is used
/// unchanged.
class StreamMaker {
 public:
  StreamMaker(const StreamLevel& level, const StreamOptions& options, std::string file);

  /// Takes the next recorded frame and appends the frames of the stream that it completes. Fails, naming the line, if
  /// the clock does not increase, or jumps by more than ten minutes.
  Result<void> Add(const RecordedFrame& frame, std::vector<SensedFrame>& stream);

 private:
  SensedFrame Sensed(const RecordedFrame& frame);

  StreamLevel level_;
  StreamOptions options_;
  std::string file_;
  std::optional<RecordedFrame> before_;
  double start_s_ = 0;
  std::size_t next_ = 0;  // index of the stream's next frame
  std::array<std::optional<glm::dvec3>, kRoleCount> last_;
};

/// A recording converted to a stream.
struct MadeStream {
  SkeletonStream stream;
  StreamLevel level;
  double start_s = 0;           ///< time of the first frame by the file's own clock
  std::size_t lost_frames = 0;  ///< number of the stream's frames without a body
};

/// Converts a whole recording to a stream. If gravity and floor must be estimated (StreamOptions::levels), all frames
/// of the recording are used.
Result<MadeStream> MakeStream(const StreamRecording& recording, const std::string& file,
                              const StreamOptions& options = {});

/// Returns the evidence of the legs whose knee, ankle and toe are tracked.
LegSides LegsOf(const SkeletonStream& stream);

}  // namespace etude
