#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/base/names.h"
#include "engine/base/order_statistics.h"
#include "engine/formats/kinect_columns.h"
#include "engine/formats/number_rows.h"
#include "engine/formats/row_rates.h"
#include "engine/formats/time_scale.h"
#include "engine/streams/format_readers.h"

namespace etude {
namespace {

/// The meaning of the columns in a row of numbers.
struct RowLayout {
  std::size_t columns;
  std::size_t joints;
  std::size_t first;   ///< index of the first joint's first number
  std::size_t stride;  ///< numbers for each joint
  bool has_fourth;     ///< the fourth number of a joint may be the joint's tracking state
};

constexpr std::size_t kV1Joints = kRoleCount, kV2Joints = kKinectV2JointCount;
constexpr RowLayout kV1Layouts[] = {{3 * kV1Joints, kV1Joints, 0, 3, false},
                                    {3 * kV1Joints + 1, kV1Joints, 1, 3, false},
                                    {4 * kV1Joints, kV1Joints, 0, 4, true},
                                    {4 * kV1Joints + 1, kV1Joints, 1, 4, true}};
constexpr RowLayout kV2Layouts[] = {{3 * kV2Joints, kV2Joints, 0, 3, false},
                                    {4 * kV2Joints, kV2Joints, 0, 4, true},
                                    {7 * kV2Joints, kV2Joints, 0, 7, false}};

std::span<const RowLayout> LayoutsOf(StreamFormat format) {
  if (format == StreamFormat::kKinectV1) return kV1Layouts;
  if (format == StreamFormat::kKinectV2) return kV2Layouts;
  return {};
}

const RowLayout* FindLayout(StreamFormat format, std::size_t columns) {
  for (const RowLayout& layout : LayoutsOf(format)) {
    if (layout.columns == columns) return &layout;
  }
  return nullptr;
}

/// Converts a point from the sensor's space (X to the sensor's left, Y up, Z away from the sensor) to a space in which
/// a person who faces the sensor looks along +Z.
glm::dvec3 FromSensor(const glm::dvec3& p) { return {-p.x, p.y, -p.z}; }

/// Returns true if the fourth number of each joint is its tracking state in the SDK (0 not tracked, 1 inferred, 2
/// tracked): all are 0, 1 or 2, and at least one is 2. In MSRC-12 the fourth number is instead a weight, which is
/// always 1.
bool FourthsAreStates(const NumberRows& table, const RowLayout& layout) {
  if (!layout.has_fourth) return false;
  bool some_tracked = false;
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    for (std::size_t j = 0; j < layout.joints; ++j) {
      const double fourth = table.Row(t)[layout.first + layout.stride * j + 3];
      if (fourth != 0 && fourth != 1 && fourth != 2) return false;
      some_tracked = some_tracked || fourth == 2;
    }
  }
  return some_tracked;
}

/// Returns true if the first column of `table` contains only integers.
bool CountsWhole(const NumberRows& table) {
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    if (table.Row(t)[0] != std::floor(table.Row(t)[0])) return false;
  }
  return true;
}

/// Returns the length in seconds of the first column's unit, by the median step between rows (in bursts, by
/// the mean step `mean_step`). A step below 1 counts seconds. Integers with a step below 16 are frame numbers at 30 Hz,
/// because no skeleton sensor is faster than 60 Hz. Larger steps have the largest unit of `kSmallUnits` that gives a
/// rate of a Kinect, or else the largest that gives at least 1 Hz. A remark states frame numbers, ticks and
/// nanoseconds. The unit is the minute if the column's heading says so. Returns nullopt if the clock stands still or
/// its steps are too large.
std::optional<double> SecondsPerCount(const NumberRows& table, const std::optional<double>& mean_step,
                                      std::vector<std::string>& remarks) {
  if (const auto headings = HeadingsOf(table.heading); !headings.empty() && NamesMinutes(headings.front())) {
    remarks.emplace_back("the heading of the times names minutes");
    return kMinute_s;
  }
  constexpr double kMinStepMs = 16;
  std::vector<double> steps;
  for (std::size_t t = 1; t < table.RowCount(); ++t) {
    const double step = table.Row(t)[0] - table.Row(t - 1)[0];
    if (step > 0) steps.push_back(step);
  }
  if (steps.empty()) return table.RowCount() == 1 ? std::optional(1 / kJudgedRateHz) : std::nullopt;
  const double step = mean_step.value_or(UpperMedian(std::move(steps)));
  if (step < 1) return 1.0;
  if (step < (CountsWhole(table) ? kMinStepMs : 5)) {
    const std::string rows = step >= 2 ? fmt::format(", with one row for every {:g} frames", step) : "";
    remarks.push_back("Etude reads the first column as frame numbers at 30 Hz" + rows);
    return 1 / kJudgedRateHz;
  }
  // Choose among the units of clocks.
  const auto rate_in = [&](const TimeUnit& unit) { return 1 / (step * unit.seconds); };
  const auto* unit = std::ranges::find_if(kSmallUnits, IsKinectRate, rate_in);
  if (unit == std::end(kSmallUnits)) {
    unit = std::ranges::find_if(
        kSmallUnits, [](double rate) { return rate >= kMinMotionRate_hz; }, rate_in);
  }
  if (unit == std::end(kSmallUnits)) return std::nullopt;
  if (unit->seconds < 1e-6) {
    remarks.push_back(fmt::format(
        "Etude reads the first column as {}, which gives a rate of {:.3g} Hz; as {}, the rate would be {:.3g} Hz",
        unit->name, rate_in(*unit), unit[-1].name, rate_in(unit[-1])));
  }
  return unit->seconds;
}

/// If the rows come in bursts (MeanStepOfBursts), returns the mean time between two rows, in the unit of the first
/// column. Returns nullopt if the rows do not come in bursts, or if the first column seems to contain frame numbers.
std::optional<double> StepOfBursts(const NumberRows& table) {
  constexpr double kMinStep = 16;  // see kMinStepMs
  std::vector<double> counts;
  for (std::size_t t = 0; t < table.RowCount(); ++t) counts.push_back(table.Row(t)[0]);
  const auto step = MeanStepOfBursts(counts);
  return step && (*step < 1 || *step >= kMinStep) ? step : std::nullopt;
}

// Converts a row to a frame. The frame lacks joints that have no position or are not tracked.
RecordedFrame FrameOf(std::span<const double> row, const RowLayout& layout, const StreamRecording& recording) {
  const bool has_states = recording.records_states;
  std::vector<std::optional<glm::dvec3>> places(layout.joints);
  std::vector<TrackingState> states(layout.joints, TrackingState::kTracked);
  for (std::size_t j = 0; j < layout.joints; ++j) {
    const std::size_t joint = recording.named_joints.empty() ? j : recording.named_joints[j];
    const auto at = row.subspan(layout.first + layout.stride * joint, layout.stride);
    const glm::dvec3 place(at[0], at[1], at[2]);
    if (std::isnan(place.x + place.y + place.z) || IsMissingPosition(place)) continue;
    if (has_states && at[3] == 0) continue;
    if (has_states && at[3] == 1) states[j] = TrackingState::kInferred;
    places[j] = FromSensor(place);
  }
  RecordedFrame frame;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const std::size_t j = layout.joints == kV2Joints ? KinectV2JointOf(AllRoles()[i]) : i;
    frame.places[i] = places[j];
    frame.states[i] = states[j];
  }
  return frame;
}

/// Converts a row to frame number `index` of the recording, with the frame's time.
Result<RecordedFrame> TimedFrame(std::span<const double> row, Place place, const RowLayout& layout,
                                 const StreamRecording& recording, std::size_t index) {
  RecordedFrame frame = FrameOf(row, layout, recording);
  frame.line = place.line;
  const double count = recording.records_times ? row[0] : static_cast<double>(index);
  if (std::isnan(count)) return Fail(std::move(place), "this row has no time, but other rows have one");
  frame.time_s = count * recording.seconds_per_count;
  return frame;
}

std::string ColumnsAllowed(StreamFormat format) {
  std::vector<std::string> counts;
  for (const RowLayout& layout : LayoutsOf(format)) counts.push_back(std::to_string(layout.columns));
  return Join(counts);
}

}  // namespace

bool HasColumnsOf(StreamFormat format, std::size_t columns) { return FindLayout(format, columns) != nullptr; }

Result<StreamRecording> ReadKinectRows(std::string_view text, const std::string& file, StreamFormat format,
                                       const StreamReading& reading) {
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(text, file, kMaxClock));
  // Find the layout by the number of columns. Then determine what the first column means, and what the fourth number of
  // each joint means.
  const RowLayout* layout = FindLayout(format, table.columns);
  if (layout == nullptr) {
    return Fail({file, table.lines.front()}, "found {} numbers in this row; allowed for {}: {}", table.columns,
                StreamFormatName(format), ColumnsAllowed(format));
  }
  StreamRecording recording{.format = format, .separator = table.separator};
  ASSIGN_OR_RETURN(recording.named_joints,
                   FindKinectJoints(table, {layout->joints, layout->first, layout->stride}, file));
  if (!std::ranges::is_sorted(recording.named_joints)) {
    recording.remarks.emplace_back(
        "the heading names the joints in another order than the SDK's; Etude uses the names");
  }
  if (table.has_decimal_commas) recording.remarks.emplace_back("Etude read commas as decimal points");
  recording.records_states = FourthsAreStates(table, *layout);
  recording.records_times = layout->first == 1 && !reading.rate_hz;
  recording.rate_hz = reading.rate_hz.value_or(kJudgedRateHz);
  const auto bursts = recording.records_times ? StepOfBursts(table) : std::nullopt;
  auto unit = recording.records_times ? SecondsPerCount(table, bursts, recording.remarks)
                                      : std::optional(1 / recording.rate_hz);
  if (unit && bursts) {
    recording.rate_hz = 1 / (*bursts * *unit);
    recording.records_times = false;
    unit = 1 / recording.rate_hz;
    recording.remarks.push_back(
        fmt::format("rows arrive in bursts; Etude takes them as evenly spaced, at {:.3g} Hz", recording.rate_hz));
  }
  if (!unit) return Fail({file, table.lines.front(), 1}, "the first column contains neither times nor frame numbers");
  recording.seconds_per_count = *unit;
  // Convert every row.
  for (std::size_t t = 0; t < table.RowCount(); ++t) {
    ASSIGN_OR_RETURN(recording.frames.emplace_back(),
                     TimedFrame(table.Row(t), {file, table.lines[t], 1}, *layout, recording, t));
  }
  return recording;
}

Result<RecordedFrame> ReadKinectRow(std::string_view row, const std::string& file, const StreamRecording& recording,
                                    std::size_t index) {
  // Put a heading before the row. The heading states the separator; without it, ReadNumberRows would take a row that
  // contains words for the heading and drop the row.
  const std::string heading = recording.separator == 0 ? "row" : std::string("row") + recording.separator + "row";
  ASSIGN_OR_RETURN(const NumberRows table, ReadNumberRows(heading + "\n" + std::string(row), file, kMaxClock));
  const RowLayout* layout = FindLayout(recording.format, table.columns);
  if (layout == nullptr || (layout->first == 0 && recording.records_times)) {
    return Fail({file, 1}, "found {} numbers in this row; allowed: as many numbers as in earlier rows", table.columns);
  }
  return TimedFrame(table.Row(0), {file, 1, 1}, *layout, recording, index);
}

}  // namespace etude
