#pragma once

#include <string>
#include <string_view>

#include "engine/streams/recording.h"

namespace etude {

/// Of each format its reader; places in the file's own unit, the rest as in ReadStreamRecording, which checks what
/// they have in common.
Result<StreamRecording> ReadEtudeCsv(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadTrcStream(std::string_view text, const std::string& file);
Result<StreamRecording> ReadKinectRows(std::string_view text, const std::string& file, StreamFormat format,
                                       const StreamReading& reading);
Result<StreamRecording> ReadNtuSkeleton(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadAzureKinect(std::string_view text, const std::string& file, const StreamReading& reading);

/// Whether rows of so many numbers can be the format's.
bool HasColumnsOf(StreamFormat format, std::size_t columns);

}  // namespace etude
