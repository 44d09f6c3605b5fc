#pragma once

#include <string>
#include <string_view>

#include "engine/streams/recording.h"

namespace etude {

/// Reads a file of one format. Places are in the file's own unit; ReadStreamRecording checks what all formats have in
/// common.
Result<StreamRecording> ReadEtudeCsv(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadTrcStream(std::string_view text, const std::string& file);
Result<StreamRecording> ReadKinectRows(std::string_view text, const std::string& file, StreamFormat format,
                                       const StreamReading& reading);
Result<StreamRecording> ReadNtuSkeleton(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadAzureKinect(std::string_view text, const std::string& file, const StreamReading& reading);

/// Reads one more row of a file that was read so far as `recording`; `index` counts its frames from 0.
Result<RecordedFrame> ReadKinectRow(std::string_view row, const std::string& file, const StreamRecording& recording,
                                    std::size_t index);

/// Reads a file with the reader of its format.
Result<StreamRecording> ReadFormat(StreamFormat format, std::string_view text, const std::string& file,
                                   const StreamReading& reading);

/// Finds the unit of places by the trunk, and makes it metres. Refuses trunks that no unit makes human.
Result<void> ToMetres(StreamRecording& recording, const std::string& file);

/// Says whether rows of so many numbers can be the format's.
bool HasColumnsOf(StreamFormat format, std::size_t columns);

}  // namespace etude
