#include <fmt/core.h>

#include <filesystem>

#include "bench/sensor_fit/statistics.h"
#include "cli/commands.h"
#include "cli/sensor_commands.h"
#include "cli/sensor_reading.h"

namespace etude {
namespace {

using Columns = std::vector<std::pair<std::string, SensorStatistics>>;

std::string ShortName(const std::string& path, std::size_t longest) {
  return std::filesystem::path(path).stem().string().substr(0, longest);
}

/// Recordings by themselves, a column each.
Result<Columns> PlainColumns(const SensorStatsOptions& options) {
  Columns columns;
  for (const std::string& file : options.files) {
    ASSIGN_OR_RETURN(const auto recording, LoadJointRecording(file, options.reading));
    fmt::print("{}: {}\n", file, DescribeRecording(recording));
    columns.emplace_back(ShortName(file, 12), StatisticsOf(recording, nullptr));
  }
  return columns;
}

/// A recording against its reference, and the simulated sensor on the reference's motion.
Result<Columns> ComparedColumns(const SensorStatsOptions& options) {
  const std::string& file = options.files.front();
  if (options.files.size() > 1) {
    return Fail({"--reference", 0, 0}, "goes with one recording, found {}", options.files.size());
  }
  ASSIGN_OR_RETURN(const auto real, LoadRealRecording(file, options.reading));
  fmt::print("{}: {}\n", file, DescribeRecording(real.recording));
  fmt::print("{}: {}\n", options.reading.reference, DescribeMatch(real));
  Columns columns = {{"real", StatisticsOf(real)}};
  if (options.simulate.empty()) return columns;
  ASSIGN_OR_RETURN(const auto sensor, LoadSensor(options.simulate));
  const WorldKey worlds{.suite_seed = 1, .scenario = "sensor-stats", .trial = 0};
  fmt::print("simulated: {} worlds of {}\n", options.worlds, options.simulate);
  const SensorStatisticsSummary simulated = SimulatedStatistics(real, sensor, options.worlds, worlds);
  columns.emplace_back("simulated", simulated.mean);
  columns.emplace_back("+-", simulated.deviation);
  return columns;
}

}  // namespace

int SensorStatsCommand(const SensorStatsOptions& options) {
  const bool compares = !options.reading.reference.empty();
  if (!compares && !options.simulate.empty()) {
    return Complain({{"--simulate", 0, 0}, "needs --reference: the simulated sensor sees the reference's motion"});
  }
  const auto columns = compares ? ComparedColumns(options) : PlainColumns(options);
  if (!columns) return Complain(columns.error());
  fmt::print("\n{}", StatisticsTable(*columns, compares));
  if (columns->size() < 2 || !compares) return kSuccess;
  const Agreement agreement = AgreementOf(columns->front().second, (*columns)[1].second);
  fmt::print("\n{} of {} within {:.0f} % (correlations: {:.2f}); ! marks the others\n", agreement.within,
             agreement.compared, 100 * kSizeTolerance, kCorrelationTolerance);
  return kSuccess;
}

}  // namespace etude
