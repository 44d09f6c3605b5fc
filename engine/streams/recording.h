#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/kinect_text.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The supported formats of skeleton files (described in docs/streams.md).
enum class StreamFormat {
  kEtudeCsv,     ///< the CSV that `etude clip convert` writes: `time_s`, `hip_centre_x_m`, …
  kTrc,          ///< markers with the names of Etude's joints
  kKinectV2,     ///< one row per frame: 25 × (x, y, z), with orientations or with states
  kKinectV1,     ///< one row per frame: 20 × (x, y, z) or (x, y, z, state), after an optional clock
  kNtu,          ///< NTU RGB+D's .skeleton
  kAzureKinect,  ///< JSON of the Azure Kinect body tracking's offline processor
};

/// Lists "etude-csv", "trc", "kinect-v2", "kinect-v1", "ntu", "azure-kinect", in the order of the enum.
const std::vector<std::string>& StreamFormatNames();
std::string_view StreamFormatName(StreamFormat format);
/// Returns the format with this name. `name` must be one of StreamFormatNames().
StreamFormat FindStreamFormat(std::string_view name);

/// Detects the format of a text by its first lines; nullopt if the format is not supported.
std::optional<StreamFormat> DetectStreamFormat(std::string_view text);

/// One frame as a file contains it.
struct RecordedFrame {
  double time_s = 0;  ///< time by the file's own clock
  int line = 0;       ///< number of the frame's line in the text, from 1; 0: not known
  /// The positions of the joints in the file's own space with Y up, metres; nullopt if a joint was not reported.
  RolePositions places = {};
  std::array<TrackingState, kRoleCount> states{};  ///< states of the joints that have a position
};

/// The lengths of human trunks, from hip centre to shoulder centre: of a toddler and of a tall adult.
inline constexpr double kMinTrunk_m = 0.15, kMaxTrunk_m = 0.95;

/// The content of a file of skeletons, before it is rotated upright and resampled.
struct StreamRecording {
  StreamFormat format = StreamFormat::kEtudeCsv;
  bool records_states = false;  ///< false: every joint that has a position counts as tracked
  bool records_times = false;   ///< false: frames are one period of `rate_hz` apart
  bool is_level = false;        ///< Y points up and the floor is at 0, by the convention of the format
  double rate_hz = kJudgedRateHz;
  double seconds_per_count = 1;            ///< the unit of the clock's column, seconds
  double first_count = 0;                  ///< the number in the clock's column at 0 s
  double metres_per_unit = 1;              ///< the factor that was applied to positions
  char separator = 0;  ///< the separator of a Kinect's rows (NumberRows::separator); 0: found in each row
  std::vector<std::size_t> named_joints = {};  ///< which joint of a Kinect's rows is which (FindKinectJoints)
  std::vector<RecordedFrame> frames = {};  ///< in ascending order of time
  std::vector<std::string> remarks = {};   ///< decisions made while reading ("2 bodies, of which body 0 is read")
};

/// Properties of a file that the user can state.
struct StreamReading {
  std::optional<StreamFormat> format = {};  ///< if absent, detected by content
  std::optional<double> rate_hz = {};       ///< frame rate of a file without a clock; if absent: 30 Hz
  std::optional<int> body = {};  ///< index of the body, by first appearance; if absent: the body in most frames
};

/// Reads a file of skeletons. Fails, with file, line and column, for an unknown format, a wrong number of joints, text
/// in place of a number, infinity, a clock that runs backwards, a body that has no human size in any unit, a file
/// without a body, and more than 64 MiB of text.
Result<StreamRecording> ReadStreamRecording(std::string_view text, const std::string& file,
                                            const StreamReading& reading = {});

}  // namespace etude
