#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/joint_csv.h"
#include "engine/streams/stream_maker.h"

namespace etude {

/// Reads skeletons line by line as a device sends them: Etude's CSV and the rows of both Kinects, told apart by the
/// first lines. What a whole file is estimated from (unit, clock, gravity and floor; CSV needs none but the clock) is
/// estimated from the first second in which a body is seen, which is then given out at once; from there on each line
/// gives its frames.
class LiveStream {
 public:
  /// Reads a stream that complaints call `name`.
  LiveStream(std::string name, const StreamReading& reading, const StreamOptions& options);

  /// Takes the next line, without its end; appends the frames now known. Refused with the line: what
  /// ReadStreamRecording and StreamMaker refuse, formats that are no rows, ten minutes without a body.
  Result<void> Take(std::string_view line, std::vector<SensedFrame>& stream);
  /// Ends the stream: appends what is left of one shorter than a second.
  Result<void> Finish(std::vector<SensedFrame>& stream);

  /// Returns the format, units and clock that the stream was found to have; nothing before the first frames are given
  /// out.
  const std::optional<StreamRecording>& Meaning() const { return meaning_; }

 private:
  Result<void> Start(bool at_end, std::vector<SensedFrame>& stream);
  Result<void> Add(const RecordedFrame& frame, std::vector<SensedFrame>& stream);
  Result<RecordedFrame> Read(std::string_view line);

  std::string name_;
  StreamReading reading_;
  StreamOptions options_;
  std::string first_lines_, heading_;
  int line_ = 0;
  int rows_ = 0;
  std::size_t frames_ = 0;
  double last_s_ = 0;
  std::optional<StreamRecording> meaning_;  // without frames
  std::optional<StreamMaker> maker_;
  std::optional<JointCsvColumns> columns_;  // of CSV, from its first live row on
};

}  // namespace etude
