#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "engine/base/result.h"
#include "engine/formats/joint_csv.h"
#include "engine/streams/body_jumps.h"
#include "engine/streams/stream_doubts.h"
#include "engine/streams/stream_maker.h"

namespace etude {

/// Reads skeletons line by line as a device sends them: Etude's CSV, and rows of Kinect v1 and v2. The format is
/// recognised from the first lines. Some properties are usually estimated from a whole file (unit, clock, gravity and
/// floor; for CSV only the clock). Here they are estimated from the first second in which a body is visible. The frames
/// of that second are returned together; afterwards each line immediately gives the frames that it completes.
class LiveStream {
 public:
  /// `name` is the stream's name in error messages.
  LiveStream(std::string name, const StreamReading& reading, const StreamOptions& options);

  /// Takes the next line, without its line end, and appends the frames that it completes. A row whose time is up to a
  /// second earlier than that of the row before is left out, and so is a damaged row after the start. A counter of 32
  /// bits may begin again at 0. After the start, a clock that jumps ahead by more than ten minutes goes on a second
  /// after the row before. Fails, with the line, for the errors of ReadStreamRecording, for more than 30 damaged rows
  /// that follow each other, for formats that do not consist of rows, and after ten minutes without a body.
  Result<void> Take(std::string_view line, std::vector<SensedFrame>& stream);
  /// Ends the stream: appends the frames of a stream that is shorter than a second, and judges it (LiveDoubts).
  Result<void> Finish(std::vector<SensedFrame>& stream);

  /// Returns the format, units and clock that were detected; nullopt before the first frames are returned.
  const std::optional<StreamRecording>& Meaning() const { return meaning_; }
  /// Returns the remarks for users since the last call: with the first frames, those of the reader of the format,
  /// and the assumed rate, up direction and floor; later one about the first row whose time is earlier than that of the
  /// row before, one each about the first damaged row and the first jump of the clock, one about the first jump of the
  /// body (BodyJumps), and the doubts of LiveDoubts.
  std::vector<std::string> TakeRemarks();

 private:
  Result<void> Start(bool at_end, std::vector<SensedFrame>& stream);
  Result<void> LeaveOut(Error error);
  double SteadyTime(double time_s);
  Result<void> Add(RecordedFrame frame, std::vector<SensedFrame>& stream);
  void Doubt(std::span<const SensedFrame> frames, bool at_end);
  Result<RecordedFrame> Read(std::string_view line);

  std::string name_;
  StreamReading reading_;
  StreamOptions options_;
  std::string first_lines_, heading_;
  int line_ = 0;
  int rows_ = 0;
  std::size_t frames_ = 0;
  double last_s_ = 0;
  bool has_gone_back_ = false, has_leapt_ = false, has_damage_ = false;
  double shift_s_ = 0;                        // converts the device's clock to the stream's times
  int damaged_ = 0;                           // number of damaged rows since the last good row
  std::array<bool, kRoleCount> elsewhere_{};  // joints that were not only at the origin (RemoveMissingPositions)
  BodyJumps jumps_;
  bool has_jumped_ = false;
  std::vector<std::string> remarks_;        // not yet taken
  std::optional<StreamRecording> meaning_;  // the recording's properties, without frames
  StreamLevel level_;
  std::optional<StreamMaker> maker_;
  std::optional<LiveDoubts> doubts_;
  std::optional<JointCsvColumns> columns_;  // columns of a CSV stream, from its heading
};

}  // namespace etude
