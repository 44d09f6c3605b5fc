#include <fmt/core.h>

#include "bench/files/files.h"
#include "bench/sensor_fit/fit.h"
#include "bench/sensor_fit/statistics.h"
#include "cli/commands.h"
#include "cli/output_file.h"
#include "cli/sensor_commands.h"
#include "cli/sensor_reading.h"
#include "sim/skeleton_sensor/options.h"

namespace etude {
namespace {

constexpr int kCheckWorlds = 64;

void PrintComparison(const char* title, const char* real_name, const RealRecording& real,
                     const SkeletonSensorOptions& sensor) {
  // Dice that the fit never saw.
  const WorldKey worlds{.suite_seed = 1, .scenario = "sensor-check", .trial = 0};
  const SensorStatistics measured = StatisticsOf(real);
  const SensorStatistics simulated = SimulatedStatistics(real, sensor, kCheckWorlds, worlds).mean;
  const Agreement agreement = AgreementOf(measured, simulated);
  fmt::print("\n{}\n{}", title, StatisticsTable({{real_name, measured}, {"simulated", simulated}}, true));
  fmt::print("{} of {} within {:.0f} % (correlations: {:.2f})\n", agreement.within, agreement.compared,
             100 * kSizeTolerance, kCorrelationTolerance);
}

/// Fits one half and compares on the other; nothing but a remark when a half is too short.
void PrintHalves(const RealRecording& real, const SensorFitOptions& options) {
  const std::size_t frames = real.recording.frames.size();
  const auto first = MakeRealRecording(Excerpt(real.recording, 0, frames / 2), real.twin);
  const auto second = MakeRealRecording(Excerpt(real.recording, frames / 2, frames), real.twin);
  if (!first || !second) {
    fmt::print("\nThe halves are too short to be fitted by themselves.\n");
    return;
  }
  fmt::print("\nHow the halves of the recording differ:\n{}",
             StatisticsTable({{"first half", StatisticsOf(*first)}, {"second half", StatisticsOf(*second)}}, true));
  PrintComparison("Fitted to the first half, compared on the second:", "second half", *second,
                  FitSensor(*first, options));
  PrintComparison("Fitted to the second half, compared on the first:", "first half", *first,
                  FitSensor(*second, options));
}

}  // namespace

int SensorFitCommand(const SensorFitCommandOptions& options) {
  if (auto checked = CheckOutput(options.output, options.overwrite); !checked) return Complain(checked.error());
  const auto base = LoadSensor(options.base);
  if (!base) return Complain(base.error());
  const auto real = LoadRealRecording(options.file, options.reading);
  if (!real) return Complain(real.error());
  fmt::print("{}: {}\n", options.file, DescribeRecording(real->recording));
  fmt::print("{}: {}\n", options.reading.reference, DescribeMatch(*real));

  const SensorFitOptions fit{.start = *base, .worlds = options.worlds, .steps = options.steps, .progress = {}};
  const SkeletonSensorOptions sensor = FitSensor(*real, fit);
  const std::string preset = FindSensorPreset(options.base) ? options.base : "v2";
  const std::string text = fmt::format("# Fitted by `etude sensor fit` to {:.1f} s, {} frames\n",
                                       real->recording.DurationSeconds(), real->recording.frames.size()) +
                           WriteSensorFile(sensor, preset);
  if (auto written = WriteFileAtomically(options.output, text); !written) return Complain(written.error());
  PrintComparison("Fitted to all of it, compared with other dice:", "real", *real, sensor);
  PrintHalves(*real, fit);
  fmt::print("\n");
  TellWritten(options.output);
  return kSuccess;
}

}  // namespace etude
