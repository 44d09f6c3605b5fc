#include "engine/streams/live_stream.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "engine/formats/joint_csv.h"
#include "engine/streams/format_readers.h"

namespace etude {
namespace {

constexpr int kMaxWaitRows = 18000;  // maximum number of rows without a body: ten minutes at 30 Hz
constexpr std::size_t kMaxLineBytes = 1 << 16;

bool IsEmptyOrComment(std::string_view line) {
  return line.find_first_not_of(" \t\r") == std::string_view::npos || line.starts_with('#') || line.starts_with("//");
}

/// Returns true if more rows are needed to understand a CSV's clock. If rows seem to be more than a second apart, the
/// clock may count milliseconds or a smaller unit; FindTimeScale needs five steps to decide. If all rows are the same,
/// the sender may repeat the frames of a slower sensor.
bool IsClockOpen(const JointCsv& csv) {
  constexpr std::size_t kSteps = 5, kRepeatedRows = 30;
  const std::size_t rows = csv.times_s.size();
  if (!csv.columns.time || rows < 2) return false;
  std::size_t steps = 0;
  for (std::size_t i = 1; i < rows; ++i) steps += csv.times_s[i] != csv.times_s[i - 1] ? 1 : 0;
  const bool is_repeated = std::ranges::count(csv.frames, csv.frames.front()) == std::ssize(csv.frames);
  if (steps == 0 && is_repeated) return rows < kRepeatedRows;
  return steps < kSteps && csv.times_s.back() - csv.times_s.front() > static_cast<double>(steps);
}

bool ShowsTrunk(const RecordedFrame& frame) {
  return frame.places[Index(Role::kHipCentre)] && frame.places[Index(Role::kShoulderCentre)];
}

}  // namespace

LiveStream::LiveStream(std::string name, const StreamReading& reading, const StreamOptions& options)
    : name_(std::move(name)), reading_(reading), options_(options) {}

// After the start, convert each line to frames.
Result<void> LiveStream::Take(std::string_view line, std::vector<SensedFrame>& stream) {
  ++line_;
  if (line.size() > kMaxLineBytes)
    return Fail({name_, line_}, "found {} bytes in a line; allowed: at most {}", line.size(), kMaxLineBytes);
  if (IsEmptyOrComment(line)) {
    if (!maker_) first_lines_ += '\n';
    return {};
  }
  if (maker_) {
    auto frame = Read(line);
    if (!frame) {
      frame.error().place.line = line_;
      return LeaveOut(std::move(frame).error());
    }
    frame->line = line_;
    return Add(*std::move(frame), stream);
  }
  // Before the start, collect lines until there are enough to estimate the unit, the up direction and the floor.
  if (rows_++ == 0) heading_ = line;
  first_lines_ += line;
  first_lines_ += '\n';
  const int wanted = static_cast<int>(kJudgedRateHz);
  const bool is_csv = DetectStreamFormat(heading_) == StreamFormat::kEtudeCsv;
  if (is_csv ? rows_ >= 3 : rows_ % wanted == 0) return Start(false, stream);
  return {};
}

Result<void> LiveStream::Finish(std::vector<SensedFrame>& stream) {
  if (!maker_) RETURN_IF_ERROR(Start(true, stream));
  Doubt({}, true);
  return {};
}

// Estimates the stream's properties from the lines read so far; does nothing if too few of these lines show a body.
Result<void> LiveStream::Start(bool at_end, std::vector<SensedFrame>& stream) {
  const auto format = reading_.format ? reading_.format : DetectStreamFormat(first_lines_);
  const bool is_rows = format && (*format == StreamFormat::kEtudeCsv || *format == StreamFormat::kKinectV1 ||
                                  *format == StreamFormat::kKinectV2);
  if (!is_rows) {
    return Fail({name_, 1}, "the stream has no rows of joint positions; allowed in live streams: {}, {}, {}",
                StreamFormatName(StreamFormat::kEtudeCsv), StreamFormatName(StreamFormat::kKinectV1),
                StreamFormatName(StreamFormat::kKinectV2));
  }
  ASSIGN_OR_RETURN(StreamRecording recording, ReadFormat(*format, first_lines_, name_, reading_));
  if (*format == StreamFormat::kEtudeCsv) {
    ASSIGN_OR_RETURN(const JointCsv csv, ReadJointCsv(first_lines_, name_));
    if (!at_end && !reading_.rate_hz && IsClockOpen(csv)) return {};
    columns_ = csv.columns;
  }
  if (options_.up && !recording.is_level) return Fail({name_}, "--up is {}", kWhereUpIsAllowed);
  const auto wanted = static_cast<std::ptrdiff_t>(kJudgedRateHz);
  const auto shown = std::ranges::count_if(recording.frames, ShowsTrunk);
  if (!recording.is_level && shown < (at_end ? 1 : wanted / 2)) {
    if (!at_end && rows_ < kMaxWaitRows) return {};
    return Fail({name_, line_}, "nobody is visible so far");
  }
  if (!recording.is_level) RETURN_IF_ERROR(ToMetres(recording, name_));
  // Estimate up direction and floor, then convert the lines read so far.
  level_ = LevelOf(recording, options_);
  maker_.emplace(level_, options_, name_);
  doubts_.emplace(StatedUp(recording, options_), options_.rate_hz);
  remarks_ = recording.remarks;
  for (std::string remark : {RateDoubt(recording), reading_.rate_hz ? std::string() : DescribeAssumedRate(recording),
                             recording.is_level || !options_.levels ? std::string() : Describe(level_)}) {
    if (!remark.empty()) remarks_.push_back(std::move(remark));
  }
  std::vector<RecordedFrame> frames = std::move(recording.frames);
  recording.frames.clear();
  meaning_ = std::move(recording);
  for (RecordedFrame& frame : frames) {
    RemoveMissingPositions(frame, elsewhere_);
    RETURN_IF_ERROR(Add(std::move(frame), stream));
  }
  first_lines_.clear();
  return {};
}

std::vector<std::string> LiveStream::TakeRemarks() { return std::exchange(remarks_, {}); }

// Leaves a damaged row out, unless so many follow each other that the stream has changed.
Result<void> LiveStream::LeaveOut(Error error) {
  constexpr int kMaxDamaged = 30;  // one second of a Kinect
  ++frames_;
  if (++damaged_ > kMaxDamaged) return tl::unexpected(std::move(error));
  if (!std::exchange(has_damage_, true)) {
    remarks_.push_back(
        fmt::format("line {}: {}; Etude leaves out this row and later damaged rows", error.place.line, error.message));
  }
  return {};
}

// Returns the time of a frame on a clock that goes on: a counter of 32 bits begins again at 0, and a clock that was set
// jumps ahead.
double LiveStream::SteadyTime(double time_s) {
  constexpr double kMaxStep_s = 1, kMaxJump_s = 600, kLoss_s = 1;
  time_s += shift_s_;
  if (frames_ == 0 || !meaning_->records_times) return time_s;
  const double wrap_s = 4294967296.0 * meaning_->seconds_per_count, wrapped_s = time_s + wrap_s - last_s_;
  if (wrapped_s > 0 && wrapped_s <= kMaxStep_s) {
    shift_s_ += wrap_s;
    return time_s + wrap_s;
  }
  if (!(time_s - last_s_ > kMaxJump_s)) return time_s;
  if (!std::exchange(has_leapt_, true)) {
    remarks_.push_back(
        fmt::format("the clock jumps from {:.6g} s to {:.6g} s in line {}; Etude replaces this jump by {:g} s without "
                    "a body, and does the same with every later jump of over {:g} s",
                    last_s_, time_s, line_, kLoss_s, kMaxJump_s));
  }
  shift_s_ -= time_s - last_s_ - kLoss_s;
  return last_s_ + kLoss_s;
}

/// Adds a frame unless the previous frame has the same time, or a time that is a little later.
Result<void> LiveStream::Add(RecordedFrame frame, std::vector<SensedFrame>& stream) {
  constexpr double kMaxBack_s = 1;
  if (auto reach = CheckReach(frame, name_); !reach) return LeaveOut(std::move(reach).error());
  damaged_ = 0;
  frame.time_s = SteadyTime(frame.time_s);
  const double back_s = frames_ > 0 ? last_s_ - frame.time_s : -1;
  ++frames_;
  if (back_s > kMaxBack_s) {
    return Fail({name_, frame.line},
                "the clock goes back by {:.3g} s, from {:.6g} s to {:.6g} s; allowed: to go back by at most {} s",
                back_s, last_s_, frame.time_s, kMaxBack_s);
  }
  if (back_s > 0 && !has_gone_back_) {
    has_gone_back_ = true;
    remarks_.push_back(fmt::format(
        "the time {:.6g} s in line {} follows {:.6g} s; Etude leaves out rows with a time before the latest time",
        frame.time_s, frame.line, last_s_));
  }
  if (back_s >= 0) return {};
  last_s_ = frame.time_s;
  if (jumps_.Take(frame) && !has_jumped_) {
    has_jumped_ = true;
    remarks_.push_back(jumps_.Describe() + "; Etude does not report later jumps");
  }
  const std::size_t before = stream.size();
  RETURN_IF_ERROR(maker_->Add(frame, stream));
  Doubt(std::span(stream).subspan(before), false);
  return {};
}

void LiveStream::Doubt(std::span<const SensedFrame> frames, bool at_end) {
  std::ranges::move(doubts_->Take(frames, at_end), std::back_inserter(remarks_));
}

// Reads one line in the format detected at the start.
Result<RecordedFrame> LiveStream::Read(std::string_view line) {
  if (meaning_->format != StreamFormat::kEtudeCsv) {
    ASSIGN_OR_RETURN(RecordedFrame frame, ReadKinectRow(line, name_, *meaning_, frames_));
    for (auto& place : frame.places) {
      if (place) *place *= meaning_->metres_per_unit;
    }
    return frame;
  }
  ASSIGN_OR_RETURN(const JointCsvRow row, ReadJointCsvRow(line, *columns_, name_));
  RecordedFrame frame{.places = row.places};
  RemoveMissingPositions(frame, elsewhere_);
  const TimeScale scale{.first = meaning_->first_count, .seconds = meaning_->seconds_per_count};
  frame.time_s =
      meaning_->records_times ? scale.SecondsOf(row.time_s) : static_cast<double>(frames_) / meaning_->rate_hz;
  if (std::isnan(frame.time_s)) return Fail({name_}, "this row has no time, but other rows have one");
  return frame;
}

}  // namespace etude
