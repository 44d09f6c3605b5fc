#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/facts.h"
#include "cli/output_file.h"
#include "engine/base/names.h"
#include "engine/streams/stream_maker.h"
#include "io/files/files.h"
#include "sim/skeleton_sensor/options.h"
#include "tools/sensor_fit/fit.h"
#include "tools/sensor_fit/statistics.h"

namespace etude {
namespace {

constexpr const char* kSensorText =
    "\n"
    "A recording is a text of a Kinect v2 (25 joints per line: x y z, or x y z and a quaternion), or a joint CSV, such "
    "as\n"
    "`etude clip convert` writes. A reference is a recording of the same motion by a trusted system: a text with 17 "
    "rigid\n"
    "targets of an optical system per line, or a joint CSV. docs/sensor.md explains the formats and each statistic.";

/// Options with facts about recordings that the recordings' files do not state.
struct SensorReading {
  std::string reference;                 ///< a recording of the same motion by an optical system, "" = none
  std::optional<double> rate_hz;         ///< the recordings' frame rate
  std::optional<double> reference_rate;  ///< the frame rate of the reference, Hz
};

void AddSensorReading(CLI::App& command, SensorReading& reading) {
  command
      .add_option("--rate", reading.rate_hz,
                  "Frame rate of the recording, in Hz (default: from the recording's times; without times, 30 Hz)")
      ->check(NumberWithin(1, 1000, "rate in Hz"));
  command
      .add_option("--reference-rate", reading.reference_rate,
                  "Frame rate of the reference, in Hz (default: from the reference's times; without times, the usual "
                  "rate at which the reference lasts as long as the recording)")
      ->check(NumberWithin(1, 10000, "rate in Hz"));
}

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
  const std::string mismatch = real ? DescribeMismatch(*real) : "";
  if (!mismatch.empty()) return Fail({reading.reference}, "shows another motion than {}: {}", path, mismatch);
  if (real) return *std::move(real);
  return Fail({path}, "cannot be compared with {}; both need at least three common joints for at least one second",
              reading.reference);
}

Result<SkeletonSensorOptions> LoadSensor(const std::string& reference) {
  if (const auto preset = FindSensorPreset(reference)) return *preset;
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(reference));
  return ReadSensorFile(text, reference);
}

double MissingShare(const JointRecording& recording) {
  std::size_t missing = 0;
  for (const RolePositions& frame : recording.frames) {
    for (const auto& place : frame) missing += !place.has_value();
  }
  const double all = static_cast<double>(recording.frames.size() * kRoleCount);
  return all > 0 ? static_cast<double>(missing) / all : 0;
}

/// Describes an unusual rotation or tilt of the sensor; "" if there is none. Statistics are computed along the line of
/// sight and across it, so a rotation about the line of sight changes no statistic.
std::string DescribeTurn(const JointRecording& recording) {
  std::vector<RecordedFrame> frames(recording.frames.size());
  for (std::size_t t = 0; t < frames.size(); ++t) frames[t].places = recording.frames[t];
  const StreamLevel level = recording.sensor_at ? EstimateLevel(frames, recording.rate_hz) : StreamLevel{};
  if (level.turn_deg != 0) return fmt::format("; the sensor is rotated by {} degrees", level.turn_deg);
  if (level.trunk_deg == 0) return "";
  return fmt::format("; the trunk is {:.0f} degrees from vertical, so the person lies or the sensor is tilted",
                     level.trunk_deg);
}

std::string AsAddition(const std::string& remark) { return remark.empty() ? "" : "; " + remark; }

std::string DescribeRecording(const JointRecording& recording) {
  return fmt::format("{} frames at {:g} Hz, {:.1f} s; {:.1f} % of the joint positions are missing{}{}",
                     recording.frames.size(), recording.rate_hz, recording.DurationSeconds(),
                     100 * MissingShare(recording), DescribeTurn(recording), AsAddition(recording.remark));
}

Json FactsOf(const std::string& file, const JointRecording& recording) {
  return {{"recording", file},
          {"frames", recording.frames.size()},
          {"rate_hz", recording.rate_hz},
          {"duration_s", recording.DurationSeconds()},
          {"missing_share", MissingShare(recording)},
          {"remark", recording.remark.empty() ? Json() : Json(recording.remark)}};
}

/// Returns the duration of the frames in which recording and reference show a common joint.
double OverlapSeconds(const RealRecording& real) {
  double frames = 0;
  for (std::size_t t = 0; t < real.recording.frames.size(); ++t) {
    const auto &sensed = real.recording.frames[t], &truth = real.match.truth[t];
    frames += std::ranges::any_of(AllRoles(), [&](Role role) { return sensed[Index(role)] && truth[Index(role)]; });
  }
  return frames / real.recording.rate_hz;
}

Json FactsOf(const RealRecording& real) {
  return {{"begins_s", -real.match.alignment.shift_s},
          {"overlap_s", OverlapSeconds(real)},
          {"rms_m", real.match.alignment.rms_m},
          {"remark", real.twin.remark.empty() ? Json() : Json(real.twin.remark)}};
}

Json FactsOf(const Agreement& agreement) { return {{"within", agreement.within}, {"compared", agreement.compared}}; }

std::string DescribeMatch(const RealRecording& real) {
  const TwinAlignment& alignment = real.match.alignment;
  return fmt::format(
      "{} frames at {:g} Hz, {:.1f} s; begins {:+.3f} s after the recording, so the two share {:.1f} s; RMS distance "
      "{:.1f} mm after alignment{}",
      real.twin.frames.size(), real.twin.rate_hz, real.twin.DurationSeconds(), -alignment.shift_s, OverlapSeconds(real),
      1000 * alignment.rms_m, AsAddition(real.twin.remark));
}

struct SensorStatsOptions {
  std::vector<std::string> files;
  SensorReading reading;
  std::string simulate;  ///< the sensor to simulate: v1, v2 (of Kinect) or a sensor file; "" = no simulation
  int worlds = 64;
  bool as_json = false;
};

using Columns = std::vector<std::pair<std::string, SensorStatistics>>;

Json FactsOf(const Columns& columns) {
  Json all = Json::array();
  for (const auto& [name, statistics] : columns) {
    Json rows = Json::array();
    for (const StatisticRow& row : RowsOf(statistics)) {
      rows.push_back({{"statistic", row.name}, {"unit", row.unit}, {"value", OrNull(row.value)}});
    }
    all.push_back({{"column", name}, {"statistics", std::move(rows)}});
  }
  return all;
}

std::string ShortName(const std::string& path, std::size_t longest) {
  return std::filesystem::path(path).stem().string().substr(0, longest);
}

/// Computes the statistics of recordings without a reference, one column for each recording, and adds facts about the
/// recordings to `facts`.
Result<Columns> PlainColumns(const SensorStatsOptions& options, Json& facts) {
  Columns columns;
  for (const std::string& file : options.files) {
    ASSIGN_OR_RETURN(const auto recording, LoadJointRecording(file, options.reading));
    fmt::print("{}: {}\n", file, DescribeRecording(recording));
    facts["recordings"].push_back(FactsOf(file, recording));
    columns.emplace_back(ShortName(file, 12), StatisticsOf(recording, nullptr));
  }
  return columns;
}

/// Computes the statistics of a recording against its reference, and the statistics of the simulated sensor for the
/// reference's motion.
Result<Columns> ComparedColumns(const SensorStatsOptions& options, Json& facts) {
  const std::string& file = options.files.front();
  if (options.files.size() > 1) {
    return Fail({"--reference", 0, 0}, "found {} recordings; --reference needs exactly one", options.files.size());
  }
  ASSIGN_OR_RETURN(const auto real, LoadRealRecording(file, options.reading));
  fmt::print("{}: {}\n", file, DescribeRecording(real.recording));
  fmt::print("{}: {}\n", options.reading.reference, DescribeMatch(real));
  facts["recordings"].push_back(FactsOf(file, real.recording));
  facts["match"] = FactsOf(real);
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

Result<int> SensorStatsCommand(const SensorStatsOptions& options) {
  const bool compares = !options.reading.reference.empty();
  if (!compares && !options.simulate.empty()) {
    return Fail({"--simulate"}, "needs --reference, because the simulated sensor measures the motion of the reference");
  }
  StdoutToStderr aside(options.as_json);
  Json facts = {{"recordings", Json::array()}, {"match", nullptr}};
  ASSIGN_OR_RETURN(const auto columns, compares ? ComparedColumns(options, facts) : PlainColumns(options, facts));
  const bool has_simulated = columns.size() >= 2 && compares;
  const Agreement agreement = has_simulated ? AgreementOf(columns.front().second, columns[1].second) : Agreement{};
  if (options.as_json) {
    aside.End();
    facts["columns"] = FactsOf(columns);
    facts["agreement"] = has_simulated ? FactsOf(agreement) : Json();
    RETURN_IF_ERROR(PrintFacts("sensor stats", std::move(facts)));
    return kSuccess;
  }
  fmt::print("\n{}", StatisticsTable(columns, compares));
  if (!has_simulated) return kSuccess;
  fmt::print(
      "\n{} of {} statistics differ from the recording's by at most {:.0f} % (correlations: {:.2f}); ! marks larger "
      "differences\n",
      agreement.within, agreement.compared, 100 * kSizeTolerance, kCorrelationTolerance);
  return kSuccess;
}

void DefineStats(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorStatsOptions>();
  CLI::App* command = sensor.add_subcommand("stats", "Compute statistics of a sensor's recordings");
  command->add_option("files", options->files, "Recordings")->required();
  command->add_option("--reference", options->reading.reference, "A recording of the same motion by a trusted system");
  command->add_option("--simulate", options->simulate,
                      "Also simulate this sensor, and compare it with the recording: v1, v2 or a sensor file");
  command->add_option("--worlds", options->worlds, "Number of simulated recordings")->check(CLI::Range(1, 10000));
  AddSensorReading(*command, options->reading);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(SensorStatsCommand(*options)); }; });
}

struct SensorFitCommandOptions {
  std::string file, output;
  SensorReading reading;
  std::string base = "v2";  ///< a preset or sensor file for the settings that are not fitted
  int worlds = 96;
  int steps = 10;
  bool overwrite = false, as_json = false;
};

constexpr int kCheckWorlds = 64;

/// Prints a table that compares a sensor with a recording, and returns the table as an entry of `checks`.
Json PrintComparison(const char* title, const char* real_name, const RealRecording& real,
                     const SkeletonSensorOptions& sensor) {
  // Use random draws that the fit has not used.
  const WorldKey worlds{.suite_seed = 1, .scenario = "sensor-check", .trial = 0};
  const SensorStatistics measured = StatisticsOf(real);
  const SensorStatistics simulated = SimulatedStatistics(real, sensor, kCheckWorlds, worlds).mean;
  const Agreement agreement = AgreementOf(measured, simulated);
  fmt::print("\n{}\n{}", title, StatisticsTable({{real_name, measured}, {"simulated", simulated}}, true));
  fmt::print("{} of {} statistics differ from the recording's by at most {:.0f} % (correlations: {:.2f})\n",
             agreement.within, agreement.compared, 100 * kSizeTolerance, kCorrelationTolerance);
  Json check = FactsOf(agreement);
  check["of"] = real_name;
  return check;
}

/// Fits each half of the recording and compares the fit with the other half. If a half is too short, prints only a note
/// about this.
void PrintHalves(const RealRecording& real, const SensorFitOptions& options, Json& checks) {
  const std::size_t frames = real.recording.frames.size();
  const auto first = MakeRealRecording(Excerpt(real.recording, 0, frames / 2), real.twin);
  const auto second = MakeRealRecording(Excerpt(real.recording, frames / 2, frames), real.twin);
  if (!first || !second) {
    fmt::print("\nThe halves of the recording are too short to be fitted separately.\n");
    return;
  }
  fmt::print("\nThe two halves of the recording, compared:\n{}",
             StatisticsTable({{"first half", StatisticsOf(*first)}, {"second half", StatisticsOf(*second)}}, true));
  checks.push_back(PrintComparison("Sensor fitted to the first half, compared with the second half:", "second half",
                                   *second, FitSensor(*first, options).sensor));
  checks.push_back(PrintComparison("Sensor fitted to the second half, compared with the first half:", "first half",
                                   *first, FitSensor(*second, options).sensor));
}

Result<int> SensorFitCommand(const SensorFitCommandOptions& options) {
  StdoutToStderr aside(options.as_json);
  RETURN_IF_ERROR(CheckOutput(options.output, options.overwrite));
  ASSIGN_OR_RETURN(const auto base, LoadSensor(options.base));
  ASSIGN_OR_RETURN(const auto real, LoadRealRecording(options.file, options.reading));
  fmt::print("{}: {}\n", options.file, DescribeRecording(real.recording));
  fmt::print("{}: {}\n", options.reading.reference, DescribeMatch(real));

  // Fit the sensor, and write the sensor file.
  const SensorFitOptions fit{.start = base, .worlds = options.worlds, .steps = options.steps, .progress = {}};
  const auto [sensor, at_bounds] = FitSensor(real, fit);
  const std::string preset = FindSensorPreset(options.base) ? options.base : "v2";
  const std::string text = fmt::format("# Fitted by `etude sensor fit` to {:.1f} s, {} frames\n",
                                       real.recording.DurationSeconds(), real.recording.frames.size()) +
                           WriteSensorFile(sensor, preset);
  RETURN_IF_ERROR(WriteFileAtomically(options.output, text));
  // Compare the fitted sensor with the recording, and the fit of each half with the other half.
  Json checks = Json::array();
  checks.push_back(PrintComparison(
      "Sensor fitted to the whole recording, compared with the recording (new random numbers):", "real", real, sensor));
  PrintHalves(real, fit, checks);
  fmt::print("\n");
  if (!at_bounds.empty()) {
    fmt::print("The sensor does not fit, because settings are at the limit of what the fit allows: {}\n",
               Join(at_bounds));
  }
  TellWritten(options.output);
  aside.End();
  if (!options.as_json) return kSuccess;
  RETURN_IF_ERROR(PrintFacts("sensor fit", {{"recordings", Json::array({FactsOf(options.file, real.recording)})},
                                            {"match", FactsOf(real)},
                                            {"checks", std::move(checks)},
                                            {"at_limits", at_bounds},
                                            {"output", options.output}}));
  return kSuccess;
}

void DefineFit(CLI::App& sensor, Action& action) {
  auto options = std::make_shared<SensorFitCommandOptions>();
  CLI::App* command =
      sensor.add_subcommand("fit", "Fit a simulated sensor to a recording, and write a sensor file for scenarios");
  command->add_option("file", options->file, "A recording")->required();
  command->add_option("--reference", options->reading.reference, "A recording of the same motion by a trusted system")
      ->required();
  command->add_option("-o,--output", options->output, "The sensor file to write (YAML)")->required();
  command->add_option("--base", options->base,
                      "The sensor from which all values are taken that are not fitted: v1, v2 or a sensor file");
  command->add_option("--worlds", options->worlds, "Simulated recordings per step")->check(CLI::Range(1, 10000));
  command
      ->add_option("--steps", options->steps,
                   "Number of steps; each step simulates recordings, compares statistics and corrects the sensor")
      ->check(CLI::Range(1, 1000));
  AddOverwrite(*command, options->overwrite);
  AddSensorReading(*command, options->reading);
  AddJson(*command, options->as_json);
  command->callback([=, &action] { action = [=] { return Finish(SensorFitCommand(*options)); }; });
}

}  // namespace

void DefineSensor(CLI::App& app, Action& action) {
  CLI::App* sensor =
      app.add_subcommand("sensor", "Compute statistics of sensor recordings, and fit simulated sensors to recordings");
  sensor->require_subcommand(1);
  sensor->footer(kSensorText);
  DefineStats(*sensor, action);
  DefineFit(*sensor, action);
}

}  // namespace etude
