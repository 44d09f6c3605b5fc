#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/kinect_text.h"
#include "engine/recognition/skeleton_stream.h"

namespace etude {

/// The files of skeletons that are understood (docs/streams.md tells each).
enum class StreamFormat {
  kEtudeCsv,     ///< what `etude clip convert` writes: `time_s`, `hip_centre_x_m`, …
  kTrc,          ///< markers named as Etude's joints
  kKinectV2,     ///< a row a frame: 25 × (x, y, z), with orientations or with states
  kKinectV1,     ///< a row a frame: 20 × (x, y, z) or × (x, y, z, state), a clock or frame number before it or not
  kNtu,          ///< NTU RGB+D's .skeleton
  kAzureKinect,  ///< JSON of the Azure Kinect body tracking's offline processor
};

/// Lists "etude-csv", "trc", "kinect-v2", "kinect-v1", "ntu", "azure-kinect": in the order of the enum.
const std::vector<std::string>& StreamFormatNames();
std::string_view StreamFormatName(StreamFormat format);
/// Returns the format of that name, which must be one of StreamFormatNames().
StreamFormat FindStreamFormat(std::string_view name);

/// The format that a text has by its first lines; nothing when it is none of them.
std::optional<StreamFormat> DetectStreamFormat(std::string_view text);

/// One frame as a file tells it.
struct RecordedFrame {
  double time_s = 0;  ///< by the file's own clock
  int line = 0;       ///< where it stands in the text, from 1; 0: not known
  /// The places of joints in the file's own space, its Y axis up, metres; nothing where a joint was not reported.
  RolePlaces places = {};
  std::array<TrackingState, kRoleCount> states{};  ///< of joints that have a place
};

/// The contents of a file, before anything is estimated or made even.
struct StreamRecording {
  StreamFormat format = StreamFormat::kEtudeCsv;
  bool tells_states = false;  ///< else every joint that has a place counts as tracked
  bool tells_times = false;   ///< else frames are one period of `rate_hz` apart
  bool is_level = false;      ///< Y points up and the floor is at 0, because Etude wrote it
  double rate_hz = kJudgedRateHz;
  double seconds_per_count = 1;            ///< of a clock in the first column
  double metres_per_unit = 1;              ///< what places were multiplied by
  std::vector<RecordedFrame> frames = {};  ///< times never fall
  std::vector<std::string> remarks = {};   ///< what reading had to decide ("2 bodies; body 0, seen longest")
};

/// Facts about a file that the file itself may not tell.
struct StreamReading {
  std::optional<StreamFormat> format = {};  ///< else told by content
  std::optional<double> rate_hz = {};       ///< of files without a clock; else 30
  std::optional<int> body = {};             ///< which of several bodies, by first appearance; else the one seen longest
};

/// Reads a file of skeletons. Refused with file, line and column: what is none of the formats, another number of
/// joints, words, infinity, clocks that run backwards, bodies that no unit makes human, no frame with a body, more than
/// 64 MiB of text.
Result<StreamRecording> ReadStreamRecording(std::string_view text, const std::string& file,
                                            const StreamReading& reading = {});

}  // namespace etude
