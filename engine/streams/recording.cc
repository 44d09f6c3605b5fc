#include "engine/streams/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/base/text.h"
#include "engine/base/utf8.h"
#include "engine/formats/joint_csv.h"
#include "engine/formats/number_rows.h"
#include "engine/formats/row_clock.h"
#include "engine/formats/row_rates.h"
#include "engine/formats/trc.h"
#include "engine/streams/body_jumps.h"
#include "engine/streams/format_readers.h"

namespace etude {
namespace {

using enum Role;

constexpr Named<StreamFormat> kFormats[] = {
    {"etude-csv", StreamFormat::kEtudeCsv}, {"trc", StreamFormat::kTrc}, {"kinect-v2", StreamFormat::kKinectV2},
    {"kinect-v1", StreamFormat::kKinectV1}, {"ntu", StreamFormat::kNtu}, {"azure-kinect", StreamFormat::kAzureKinect}};

bool IsWholeNumber(std::string_view line) {
  return !line.empty() && line.size() <= 9 && line.find_first_not_of("0123456789") == std::string_view::npos;
}

/// Returns the number of columns in the first row of numbers; 0 if the text has no such row.
std::size_t FirstRowColumns(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = Trimmed(TakeLine(text));
    if (line.empty()) continue;
    const auto row = ReadNumberRows(line, "", kMaxClock);
    if (row) return row->columns;
  }
  return 0;
}

Result<void> CheckRoles(const StreamRecording& recording, const std::string& file) {
  std::vector<std::string> missing;
  for (const Role role : AllRoles()) {
    const auto has = [&](const RecordedFrame& frame) { return frame.places[Index(role)].has_value(); };
    if (std::ranges::none_of(recording.frames, has)) missing.emplace_back(RoleName(role));
  }
  if (missing.size() == kRoleCount) return Fail({file}, "no frame shows a body");
  if (!missing.empty())
    return Fail({file}, "no frame shows {}; allowed: recordings that show all {} joints", Join(missing), kRoleCount);
  return {};
}

/// Fails for a TRC file that lacks a joint; the message lists the marker names that are not joints.
Result<void> CheckMarkerNames(const std::vector<std::string>& names, const std::string& file) {
  constexpr int kNamesLine = 4;
  constexpr std::size_t kMaxListed = 8;
  std::vector<std::string> unknown, missing;
  for (const std::string& name : names) {
    if (!FindRole(name)) unknown.push_back(Quote(name));
  }
  for (const Role role : AllRoles()) {
    if (std::ranges::find(names, RoleName(role)) == names.end()) missing.emplace_back(RoleName(role));
  }
  if (missing.empty() || unknown.empty()) return {};  // without unknown names, CheckRoles reports the missing joints
  const std::size_t more = unknown.size() - std::min(unknown.size(), kMaxListed);
  unknown.resize(unknown.size() - more);
  const std::string rest = more > 0 ? fmt::format(" and {} more", more) : "";
  return Fail({file, kNamesLine},
              "unknown marker names {}{}; missing markers: {}; `etude clip convert` can read other marker sets",
              Join(unknown), rest, Join(missing));
}

/// Returns the distance between two joints, median over the frames that have both joints; 0 without such frames.
double MiddleDistance(const StreamRecording& recording, Role a, Role b) {
  std::vector<double> lengths;
  for (const RecordedFrame& frame : recording.frames) {
    const auto &from = frame.places[Index(a)], &to = frame.places[Index(b)];
    if (from && to) lengths.push_back(glm::distance(*from, *to));
  }
  if (lengths.empty()) return 0;
  return UpperMedian(std::move(lengths));
}

/// Returns the greatest distance along Z between two joints of a frame; nullopt if no frame has ten joints or more.
std::optional<double> GreatestDepth(const StreamRecording& recording) {
  constexpr std::ptrdiff_t kMinJoints = 10;
  std::optional<double> greatest;
  for (const RecordedFrame& frame : recording.frames) {
    if (std::ranges::count_if(frame.places, [](const auto& place) { return place.has_value(); }) < kMinJoints) continue;
    std::optional<std::pair<double, double>> range;
    for (const auto& place : frame.places) {
      if (!place) continue;
      range = range ? std::pair(std::min(range->first, place->z), std::max(range->second, place->z))
                    : std::pair(place->z, place->z);
    }
    greatest = std::max(greatest.value_or(0), range->second - range->first);
  }
  return greatest;
}

/// Removes the positions of all frames that stand for missing joints.
void RemoveMissingPositions(std::vector<RecordedFrame>& frames) {
  std::array<bool, kRoleCount> elsewhere{};
  for (RecordedFrame& frame : std::vector(frames)) RemoveMissingPositions(frame, elsewhere);
  for (RecordedFrame& frame : frames) RemoveMissingPositions(frame, elsewhere);
}

/// Returns the time of each row on the grid, seconds from the first row; empty if a row is on no frame.
std::vector<double> TimesOnGrid(const RowGrid& grid, std::size_t rows) {
  std::vector<double> times;
  for (std::size_t k = 0; k < grid.frames.size(); ++k) {
    const GridFrame& frame = grid.frames[k];
    if (!frame.is_hole && frame.part == 0 && frame.row == times.size())
      times.push_back(static_cast<double>(k) / grid.rate_hz);
  }
  return times.size() == rows ? times : std::vector<double>{};
}

/// Checks that times do not decrease. If several frames have the same time, keeps only the first of these frames, as
/// LiveStream does, which cannot wait for the next frame.
Result<void> OrderTimes(StreamRecording& recording, const std::string& file) {
  std::vector<RecordedFrame> ordered;
  for (const RecordedFrame& frame : recording.frames) {
    if (!ordered.empty() && frame.time_s < ordered.back().time_s) {
      return Fail({file, frame.line}, "the time {:.6g} s follows {:.6g} s; allowed: times that do not decrease",
                  frame.time_s, ordered.back().time_s);
    }
    if (ordered.empty() || frame.time_s > ordered.back().time_s) ordered.push_back(frame);
  }
  if (const std::size_t twice = recording.frames.size() - ordered.size(); twice > 0) {
    recording.remarks.push_back(
        fmt::format("{} frames have the same time as another frame; Etude uses the first frame of each time", twice));
  }
  recording.frames = std::move(ordered);
  return {};
}

/// Returns the rate that the frames' times give; nullopt without times or with fewer than six frames.
std::optional<double> RateOfTimes(const StreamRecording& recording) {
  constexpr std::size_t kMinSteps = 5;
  std::vector<double> steps;
  for (std::size_t t = 1; t < recording.frames.size(); ++t) {
    steps.push_back(recording.frames[t].time_s - recording.frames[t - 1].time_s);
  }
  if (!recording.records_times || steps.size() < kMinSteps) return std::nullopt;
  return 1 / Median(std::move(steps));
}

/// Fails if the frames have a rate at which nobody records people, because the clock is then in another unit.
Result<void> CheckRate(const StreamRecording& recording, const std::string& file) {
  const auto rate = RateOfTimes(recording);
  constexpr double kRounding = 1e-6;
  const bool is_allowed =
      !rate || (*rate >= kMinMotionRate_hz * (1 - kRounding) && *rate <= kMaxMotionRate_hz * (1 + kRounding));
  if (is_allowed) return {};
  return Fail({file},
              "the times give a rate of {:.3g} Hz; allowed: {:g} to {:g} Hz, with times in the unit of the file "
              "format; use `--rate 30` to replace the times by a rate",
              *rate, kMinMotionRate_hz, kMaxMotionRate_hz);
}

}  // namespace

const std::vector<std::string>& StreamFormatNames() {
  static const std::vector<std::string> names = NamesOf(kFormats);
  return names;
}

std::string_view StreamFormatName(StreamFormat format) { return kFormats[static_cast<std::size_t>(format)].name; }

StreamFormat FindStreamFormat(std::string_view name) { return ValueNamed(kFormats, name); }

std::optional<StreamFormat> DetectStreamFormat(std::string_view text) {
  // Recognise formats with keywords by their first lines.
  text = WithoutByteOrderMark(text);
  const std::size_t start = text.find_first_not_of(" \t\r\n");
  if (start == std::string_view::npos) return std::nullopt;
  if (text[start] == '{') return StreamFormat::kAzureKinect;
  std::string_view rest = text.substr(start);
  const std::string_view first = Trimmed(TakeLine(rest)), second = Trimmed(TakeLine(rest));
  if (first.starts_with("PathFileType")) return StreamFormat::kTrc;
  if (first.find("_x_m") != std::string_view::npos) return StreamFormat::kEtudeCsv;
  if (IsWholeNumber(first) && IsWholeNumber(second)) return StreamFormat::kNtu;
  // Recognise rows of numbers by the number of their columns.
  const std::size_t columns = FirstRowColumns(text);
  for (const StreamFormat format : {StreamFormat::kKinectV2, StreamFormat::kKinectV1}) {
    if (HasColumnsOf(format, columns)) return format;
  }
  return std::nullopt;
}

Result<StreamRecording> ReadFormat(StreamFormat format, std::string_view text, const std::string& file,
                                   const StreamReading& reading) {
  switch (format) {
    case StreamFormat::kEtudeCsv:
      return ReadEtudeCsv(text, file, reading);
    case StreamFormat::kTrc:
      return ReadTrcStream(text, file);
    case StreamFormat::kKinectV2:
    case StreamFormat::kKinectV1:
      return ReadKinectRows(text, file, format, reading);
    case StreamFormat::kNtu:
      return ReadNtuSkeleton(text, file, reading);
    case StreamFormat::kAzureKinect:
      return ReadAzureKinect(text, file, reading);
  }
  return Fail({file}, "no format");
}

std::string RateDoubt(const StreamRecording& recording) {
  using enum StreamFormat;
  const auto rate = RateOfTimes(recording);
  if (!rate || IsKinectRate(*rate) || recording.format == kEtudeCsv || recording.format == kTrc) return "";
  return fmt::format(
      "the times give a rate of {:.3g} Hz, but a Kinect has 5 to 130 Hz; are the times in another unit? Use `--rate "
      "30` to replace the times by a rate",
      *rate);
}

Result<void> CheckReach(const RecordedFrame& frame, const std::string& file) {
  constexpr double kMaxDistance_m = 100;
  for (const Role role : AllRoles()) {
    const auto& place = frame.places[Index(role)];
    if (!place || glm::length(*place) <= kMaxDistance_m) continue;
    return Fail({file, frame.line}, "{} is {:.3g} m away from the origin; allowed: at most {} m", RoleName(role),
                glm::length(*place), kMaxDistance_m);
  }
  return {};
}

void RemoveMissingPositions(RecordedFrame& frame, std::array<bool, kRoleCount>& elsewhere) {
  const auto is_elsewhere = [](const auto& place) { return place && !IsMissingPosition(*place); };
  const bool shows_body = std::ranges::any_of(frame.places, is_elsewhere);
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    if (is_elsewhere(frame.places[i])) elsewhere[i] = true;
    if (!is_elsewhere(frame.places[i]) && (elsewhere[i] || !shows_body)) frame.places[i].reset();
  }
}

Result<void> ToMetres(StreamRecording& recording, const std::string& file) {
  constexpr double kMinDepth_m = 0.01;
  const double trunk = MiddleDistance(recording, kHipCentre, kShoulderCentre);
  const struct {
    double metres;
    std::string_view name;
  } units[] = {{1, "metres"}, {0.01, "centimetres"}, {0.001, "millimetres"}};
  for (const auto& [metres, name] : units) {
    if (!(trunk * metres >= kMinTrunk_m && trunk * metres <= kMaxTrunk_m)) continue;
    if (const auto depth = GreatestDepth(recording); depth && *depth * metres < kMinDepth_m) {
      return Fail({file},
                  "the body is at most {:.2g} m deep in every frame; allowed: at least {} m; are these pixels of a "
                  "picture, whose third number is a score?",
                  *depth * metres, kMinDepth_m);
    }
    if (metres == 1) return {};
    recording.remarks.push_back(fmt::format("places in {}", name));
    recording.metres_per_unit = metres;
    for (RecordedFrame& frame : recording.frames) {
      for (auto& place : frame.places) {
        if (place) *place *= metres;
      }
    }
    return {};
  }
  return Fail(
      {file},
      "the distance from hip centre to shoulder centre is {:.3g}; allowed: {} to {} m, with positions in m, cm or mm",
      trunk, kMinTrunk_m, kMaxTrunk_m);
}

Result<StreamRecording> ReadStreamRecording(std::string_view text, const std::string& file,
                                            const StreamReading& reading) {
  if (text.size() > kMaxNumberTextBytes) {
    return Fail({file}, "found {} bytes; allowed: at most {}", text.size(), kMaxNumberTextBytes);
  }
  // Detect the format and read the file.
  const auto format = reading.format ? reading.format : DetectStreamFormat(text);
  if (!format) {
    const std::size_t columns = FirstRowColumns(text);
    const std::string found = columns == 0 ? "no rows of numbers" : fmt::format("{} numbers in the first row", columns);
    return Fail({file, 1},
                "this is no known format of skeleton recordings ({}); allowed: {}; rows of a Kinect v2 have 75, 100 or "
                "175 numbers, rows of a Kinect v1 have 60, 61, 80 or 81",
                found, Join(StreamFormatNames()));
  }
  ASSIGN_OR_RETURN(StreamRecording recording, ReadFormat(*format, text, file, reading));
  // Apply the checks that all formats share.
  RETURN_IF_ERROR(CheckRoles(recording, file));
  RETURN_IF_ERROR(OrderTimes(recording, file));
  RETURN_IF_ERROR(CheckRate(recording, file));
  if (!recording.is_level) RETURN_IF_ERROR(ToMetres(recording, file));
  for (const RecordedFrame& frame : recording.frames) RETURN_IF_ERROR(CheckReach(frame, file));
  // Add doubts.
  BodyJumps jumps;
  for (const RecordedFrame& frame : recording.frames) jumps.Take(frame);
  for (std::string remark : {RateDoubt(recording), jumps.Describe()}) {
    if (!remark.empty()) recording.remarks.push_back(std::move(remark));
  }
  return recording;
}

Result<StreamRecording> ReadEtudeCsv(std::string_view text, const std::string& file, const StreamReading& reading) {
  ASSIGN_OR_RETURN(JointCsv csv, ReadJointCsv(text, file));
  StreamRecording recording{.format = StreamFormat::kEtudeCsv, .is_level = true};
  recording.records_times = csv.rate_hz.has_value() && !reading.rate_hz;
  recording.seconds_per_count = csv.scale.seconds;
  recording.first_count = csv.scale.first;
  if (!csv.remark.empty()) recording.remarks.push_back(csv.remark);
  recording.rate_hz = reading.rate_hz.value_or(csv.rate_hz.value_or(kJudgedRateHz));
  if (const auto step_s = MeanStepOfBursts(csv.times_s); step_s && recording.records_times) {
    recording.records_times = false;
    recording.rate_hz = 1 / *step_s;
    recording.remarks.push_back(
        fmt::format("rows arrive in bursts; Etude takes them as evenly spaced, at {:.3g} Hz", recording.rate_hz));
  }
  const std::vector<double> counted = TimesOfNumbers(csv.numbers, recording.rate_hz);
  for (std::size_t t = 0; t < csv.frames.size(); ++t) {
    RecordedFrame& frame = recording.frames.emplace_back();
    frame.time_s = static_cast<double>(t) / recording.rate_hz;
    if (recording.records_times) frame.time_s = csv.times_s[t];
    if (!recording.records_times && !counted.empty()) frame.time_s = counted[t];
    frame.line = csv.lines[t];
    frame.places = csv.frames[t];
    if (std::isnan(frame.time_s)) return Fail({file, frame.line}, "this row has no time, but other rows have one");
  }
  RemoveMissingPositions(recording.frames);
  return recording;
}

Result<StreamRecording> ReadTrcStream(std::string_view text, const std::string& file) {
  ASSIGN_OR_RETURN(MarkerRows rows, ReadTrcRows(text, file));
  const MarkerMotion& markers = rows.markers;
  const auto told = rows.rate_name.empty() ? std::nullopt : std::optional(markers.rate_hz);
  const TimeScale scale = FindTimeScale(rows.times_s, {told, rows.rate_name});
  for (double& time : rows.times_s) time = scale.SecondsOf(time);
  RETURN_IF_ERROR(CheckMarkerNames(markers.names, file));
  // Place rows of constant rate exactly one period apart, because their written times are rounded.
  ASSIGN_OR_RETURN(const auto grid, GridOfRows(rows.times_s, rows.lines, told, markers.names.size(), file));
  StreamRecording recording{.format = StreamFormat::kTrc, .records_times = true, .is_level = true};
  if (!grid && !told) return Fail({file, 3}, "DataRate is 0, and all rows have the same time");
  recording.rate_hz = grid ? grid->rate_hz : markers.rate_hz;
  for (const std::string& remark : {markers.remark, scale.remark}) {
    if (!remark.empty()) recording.remarks.push_back(remark);
  }
  const std::vector<double> evenly = grid ? TimesOnGrid(*grid, markers.frames.size()) : std::vector<double>{};
  for (std::size_t t = 0; t < markers.frames.size(); ++t) {
    RecordedFrame& frame = recording.frames.emplace_back();
    frame.time_s = !grid            ? static_cast<double>(t) / recording.rate_hz
                   : evenly.empty() ? rows.times_s[t]
                                    : rows.times_s.front() + evenly[t];
    frame.line = rows.lines[t];
    for (std::size_t marker = 0; marker < markers.names.size(); ++marker) {
      if (const auto role = FindRole(markers.names[marker])) frame.places[Index(*role)] = markers.frames[t][marker];
    }
  }
  RemoveMissingPositions(recording.frames);
  return recording;
}

}  // namespace etude
