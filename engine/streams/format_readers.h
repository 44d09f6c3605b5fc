#pragma once

#include <string>
#include <string_view>

#include "engine/streams/recording.h"

namespace etude {

/// Each function reads one format. The positions in the result are in the file's own unit. ReadStreamRecording then
/// applies the checks that all formats share.
Result<StreamRecording> ReadEtudeCsv(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadTrcStream(std::string_view text, const std::string& file);
Result<StreamRecording> ReadKinectRows(std::string_view text, const std::string& file, StreamFormat format,
                                       const StreamReading& reading);
Result<StreamRecording> ReadNtuSkeleton(std::string_view text, const std::string& file, const StreamReading& reading);
Result<StreamRecording> ReadAzureKinect(std::string_view text, const std::string& file, const StreamReading& reading);

/// Reads one more row of a file. `recording` holds the rows before it; `index` is the new frame's index from 0.
Result<RecordedFrame> ReadKinectRow(std::string_view row, const std::string& file, const StreamRecording& recording,
                                    std::size_t index);

/// Reads a file with the reader of its format.
Result<StreamRecording> ReadFormat(StreamFormat format, std::string_view text, const std::string& file,
                                   const StreamReading& reading);

/// Determines the unit of the positions from the trunk's length, and converts positions to metres. Fails if no unit
/// gives a human trunk.
Result<void> ToMetres(StreamRecording& recording, const std::string& file);

/// Returns true if the format has rows of `columns` numbers.
bool HasColumnsOf(StreamFormat format, std::size_t columns);

}  // namespace etude
