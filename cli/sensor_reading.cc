#include "cli/sensor_reading.h"

#include <fmt/core.h>

#include "bench/files/files.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {

Result<JointRecording> LoadJointRecording(const std::string& path, const SensorReading& reading) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  return ReadJointRecording(text, path, reading.rate_hz);
}

Result<RealRecording> LoadRealRecording(const std::string& path, const SensorReading& reading) {
  ASSIGN_OR_RETURN(auto recording, LoadJointRecording(path, reading));
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(reading.reference));
  ASSIGN_OR_RETURN(auto twin,
                   ReadTwinMotion(text, reading.reference, reading.reference_rate, recording.DurationSeconds()));
  auto real = MakeRealRecording(std::move(recording), std::move(twin));
  if (real) return *std::move(real);
  return Fail({path}, "does not go together with {}: they need a second of at least three joints in common",
              reading.reference);
}

Result<SkeletonSensorOptions> LoadSensor(const std::string& reference) {
  if (const auto preset = FindSensorPreset(reference)) return *preset;
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(reference));
  return ReadSensorFile(text, reference);
}

std::string DescribeRecording(const JointRecording& recording) {
  std::size_t missing = 0;
  for (const RolePlaces& frame : recording.frames) {
    for (const auto& place : frame) missing += !place.has_value();
  }
  const double all = static_cast<double>(recording.frames.size() * kRoleCount);
  return fmt::format("{} frames at {:g} Hz, {:.1f} s; {:.1f} % of the joints missing", recording.frames.size(),
                     recording.rate_hz, recording.DurationSeconds(),
                     all > 0 ? 100 * static_cast<double>(missing) / all : 0);
}

std::string DescribeMatch(const RealRecording& real) {
  const TwinAlignment& alignment = real.match.alignment;
  return fmt::format("{} frames at {:g} Hz, {:.1f} s; begins {:+.3f} s from the recording; {:.1f} mm RMS left",
                     real.twin.frames.size(), real.twin.rate_hz, real.twin.DurationSeconds(), -alignment.shift_s,
                     1000 * alignment.rms_m);
}

}  // namespace etude
