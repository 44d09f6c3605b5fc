#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>

#include "engine/streams/recording.h"

namespace etude {

/// The largest number in a table: nanoseconds since 1970, with a margin.
inline constexpr double kMaxClock = 1e19;

/// Returns true for three coordinates that stand for a missing joint: 0, 0, 0 or −1, −1, −1.
inline bool IsMissingPosition(const glm::dvec3& place) { return place == glm::dvec3(0) || place == glm::dvec3(-1); }

/// Removes the positions of a frame that stand for a missing joint (IsMissingPosition). It is for formats whose origin
/// may be a point of the body: a position at the origin stands for a missing joint only if the joint has other
/// positions in the recording, or if all joints of the frame are at the origin. `elsewhere` tells which joints have
/// other positions; this frame's are added to it.
void RemoveMissingPositions(RecordedFrame& frame, std::array<bool, kRoleCount>& elsewhere);

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
/// gives a human trunk, or if the body is flat: then the positions are pixels of a picture.
Result<void> ToMetres(StreamRecording& recording, const std::string& file);

/// Returns true for a frame rate that a Kinect's recordings have, 5 to 130 Hz, with a margin for jitter.
inline bool IsKinectRate(double rate_hz) { return rate_hz > 4.75 && rate_hz < 133; }

/// Fails if a joint is farther from the sensor than a person can be. The positions are in metres.
Result<void> CheckReach(const RecordedFrame& frame, const std::string& file);

/// Returns a remark if the times of a Kinect's recording give a rate that no Kinect has (IsKinectRate); else "".
std::string RateDoubt(const StreamRecording& recording);

/// Returns true if the format has rows of `columns` numbers.
bool HasColumnsOf(StreamFormat format, std::size_t columns);

}  // namespace etude
