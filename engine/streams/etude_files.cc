#include <cmath>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/trc.h"
#include "engine/streams/format_readers.h"

namespace etude {

Result<StreamRecording> ReadEtudeCsv(std::string_view text, const std::string& file, const StreamReading& reading) {
  ASSIGN_OR_RETURN(JointCsv csv, ReadJointCsv(text, file));
  StreamRecording recording{.format = StreamFormat::kEtudeCsv, .is_level = true};
  recording.tells_times = csv.rate_hz.has_value() && !reading.rate_hz;
  recording.rate_hz = reading.rate_hz.value_or(csv.rate_hz.value_or(kJudgedRateHz));
  for (std::size_t t = 0; t < csv.frames.size(); ++t) {
    RecordedFrame& frame = recording.frames.emplace_back();
    frame.time_s = recording.tells_times ? csv.times_s[t] : static_cast<double>(t) / recording.rate_hz;
    frame.line = csv.lines[t];
    frame.places = csv.frames[t];
    if (std::isnan(frame.time_s)) return Fail({file, frame.line}, "no time, although other rows tell one");
  }
  return recording;
}

Result<StreamRecording> ReadTrcStream(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(const MarkerMotion markers, ReadTrc(text, file));
  StreamRecording recording{
      .format = StreamFormat::kTrc, .tells_times = true, .is_level = true, .rate_hz = markers.rate_hz};
  for (const auto& places : markers.frames) {
    const auto t = static_cast<double>(recording.frames.size());
    RecordedFrame& frame = recording.frames.emplace_back();
    frame.time_s = t / markers.rate_hz;
    for (std::size_t marker = 0; marker < places.size(); ++marker) {
      if (const auto role = FindRole(markers.names[marker])) frame.places[Index(*role)] = places[marker];
    }
  }
  return recording;
}

}  // namespace etude
