#include "tools/sensor_fit/recording.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "engine/formats/joint_csv.h"
#include "tests/sim/performer/all_moves.h"
#include "tests/support/results.h"
#include "tools/sensor_fit/alignment.h"

// Joint CSV files whose rows are not evenly spaced, and files in other units.

namespace etude {
namespace {

using testing::HasSubstr;

constexpr std::size_t kFirst = 40, kEnd = 70;  // the rows that a gap lacks

/// Returns a dance as CSV, of which the rows [first, end) are missing, and the column time_s if `has_times` is false.
std::string Dance(std::size_t first, std::size_t end, double scale = 1, bool has_times = true) {
  BodyMotion motion = AfterEachOther({"boxing", "side_kick"});
  for (BodyPose& pose : motion.poses) {
    for (glm::dvec3& joint : pose.joints) joint *= scale;
  }
  std::string text;
  std::size_t line = 0;
  const std::string whole = WriteJointCsv(motion);
  for (std::string_view rest = whole; !rest.empty(); ++line) {
    const std::size_t length = std::min(rest.find('\n'), rest.size() - 1) + 1;
    std::string row(rest.substr(0, length));
    if (!has_times) row.erase(row.find(','), row.find(',', row.find(',') + 1) - row.find(','));
    if (line <= first || line > end) text += row;
    rest.remove_prefix(length);
  }
  return text;
}

std::size_t SeenFrames(const JointRecording& recording) {
  return static_cast<std::size_t>(
      std::ranges::count_if(recording.frames, [](const auto& places) { return places[0].has_value(); }));
}

TEST(ReadJointRecording, LeavesTheFramesOfMissingRowsEmpty) {
  ASSERT_OK(whole, ReadJointRecording(Dance(0, 0), "whole.csv", {}));
  EXPECT_EQ(whole->remark, "");
  for (const bool has_times : {true, false}) {  // without times, the frame numbers say it
    ASSERT_OK(read, ReadJointRecording(Dance(kFirst, kEnd, 1, has_times), "gap.csv", {}));
    ASSERT_EQ(read->frames.size(), whole->frames.size());
    EXPECT_EQ(SeenFrames(*read), whole->frames.size() - (kEnd - kFirst));
    EXPECT_FALSE(read->frames[kFirst][0]);
    EXPECT_EQ(read->frames[kEnd], whole->frames[kEnd]);
    EXPECT_THAT(read->remark, HasSubstr("30 of "));
  }
  // A rate that the user states replaces the rate of the times, not the gap.
  ASSERT_OK(faster, ReadJointRecording(Dance(kFirst, kEnd), "gap.csv", 60));
  EXPECT_EQ(faster->rate_hz, 60);
  EXPECT_EQ(faster->frames.size(), whole->frames.size());
}

/// Returns the dance as CSV. The time of each row is changed by `late_s(row)`; up to a second, its pose is that of the
/// changed time.
template <typename Late>
std::string DanceAt(const Late& late_s) {
  const auto csv = ReadJointCsv(Dance(0, 0), "whole.csv");
  std::string text = csv->columns.heading + "\n";
  for (std::size_t row = 0; row < csv->frames.size(); ++row) {
    const double late = late_s(row), part = std::abs(late) < 1 ? late * 30 : 0;
    const std::size_t other = std::clamp<std::size_t>(part < 0 ? row - 1 : row + 1, 0, csv->frames.size() - 1);
    text += fmt::format("{},{:.9f}", row, csv->times_s[row] + late);
    for (std::size_t j = 0; j < kRoleCount; ++j) {
      const glm::dvec3 place = glm::mix(*csv->frames[row][j], *csv->frames[other][j], std::abs(part));
      text += fmt::format(",{},{},{}", place.x, place.y, place.z);
    }
    text += "\n";
  }
  return text;
}

TEST(ReadJointRecording, KeepsTheRowsOfUnevenTimesAndTheirTimes) {
  ASSERT_OK(whole, ReadJointRecording(Dance(0, 0), "whole.csv", {}));
  const auto late_s = [](std::size_t row) { return 0.009 * std::sin(2.2 * static_cast<double>(row)); };
  const std::string text = DanceAt(late_s);
  ASSERT_OK(rows, ReadJointCsv(text, "uneven.csv"));
  ASSERT_OK(read, ReadJointRecording(text, "uneven.csv", {}));
  EXPECT_EQ(read->frames, rows->frames) << "interpolation would average the noise away";
  for (std::size_t k = 0; k < read->frames.size(); k += 7) {
    EXPECT_NEAR(read->TimeOf(k) - read->TimeOf(0), whole->TimeOf(k) + late_s(k) - late_s(0), 1e-3);
  }
  EXPECT_EQ(Excerpt(*read, 3, 9).late_s, std::vector(read->late_s.begin() + 3, read->late_s.begin() + 9));
  // The reference is interpolated at the times of the recording's rows.
  ASSERT_OK(twin, ReadTwinMotion(Dance(0, 0), "whole.csv", {}, 1));
  ASSERT_OK(match, AlignTwin(*read, *twin));
  JointRecording even = *read;
  even.late_s.clear();
  ASSERT_OK(matched_evenly, AlignTwin(even, *twin));
  EXPECT_LT(match->alignment.rms_m, 0.5 * matched_evenly->alignment.rms_m);
}

TEST(ReadJointRecording, NoRowOfAJitteringClockIsLost) {
  // The first row is 0.4 frames late and others are as early, so often two rows are nearest to one frame after the
  // first.
  const auto late_s = [](std::size_t row) { return 0.0133 * std::cos(2.2 * static_cast<double>(row)); };
  const std::string text = DanceAt(late_s);
  ASSERT_OK(rows, ReadJointCsv(text, "jitter.csv"));
  ASSERT_OK(read, ReadJointRecording(text, "jitter.csv", {}));
  EXPECT_EQ(SeenFrames(*read), rows->frames.size());
  for (std::size_t row = 0, k = 0; row < rows->frames.size() && k < read->frames.size(); ++k) {
    if (!read->frames[k][0]) continue;
    EXPECT_EQ(read->frames[k], rows->frames[row]);
    EXPECT_NEAR(read->TimeOf(k) - read->TimeOf(0), rows->times_s[row] - rows->times_s[0], 1e-6);
    ++row;
  }
}

TEST(ReadJointRecording, OfRowsOfEqualTimesTheLastCounts) {
  const std::string once = DanceAt([](std::size_t row) { return 0.009 * std::sin(2.2 * static_cast<double>(row)); });
  // Repeat a row's number and time before it, with the joints of another row.
  std::vector<std::string> lines;
  std::istringstream rows(once);
  for (std::string line; std::getline(rows, line);) lines.push_back(line);
  const auto after_time = [](const std::string& line) { return line.find(',', line.find(',') + 1); };
  const std::string joints = lines[60].substr(after_time(lines[60]));
  lines.insert(lines.begin() + 50, lines[50].substr(0, after_time(lines[50])) + joints);
  std::string twice;
  for (const std::string& line : lines) twice += line + "\n";
  ASSERT_OK(read, ReadJointRecording(once, "once.csv", {}));
  ASSERT_OK(repeated, ReadJointRecording(twice, "twice.csv", {}));
  EXPECT_EQ(repeated->frames, read->frames);
  EXPECT_EQ(repeated->late_s, read->late_s);
  EXPECT_EQ(read->remark, "");
  EXPECT_EQ(repeated->remark, "Etude does not use rows that are too near to other rows in time: 1");
}

TEST(ReadJointRecording, SaysWhyTimesAreNotUsed) {
  const std::string jump = DanceAt([](std::size_t row) { return row < 100 ? 0.0 : 9000.0; });
  EXPECT_FALSE(ReadJointRecording(jump, "jump.csv", {}));
  ASSERT_OK(read, ReadJointRecording(jump, "jump.csv", 30));
  EXPECT_EQ(SeenFrames(*read), read->frames.size());
  EXPECT_THAT(read->remark, HasSubstr("Etude does not use the times: jump.csv:102"));
}

TEST(ReadTwinMotion, AReferenceWithMissingRowsFitsTheWholeRecording) {
  ASSERT_OK(recording, ReadJointRecording(Dance(0, 0), "whole.csv", {}));
  ASSERT_OK(twin, ReadTwinMotion(Dance(kFirst, kEnd), "gap.csv", {}, 1));
  ASSERT_OK(match, AlignTwin(*recording, *twin));
  EXPECT_LT(match->alignment.rms_m, 0.002);
  EXPECT_THAT(twin->remark, HasSubstr("in 1 gap"));
}

TEST(ReadJointRecording, RefusesBonesThatNobodyHas) {
  for (const double scale : {1000.0, 100.0, 0.01}) {
    EXPECT_THAT(testing::Refusal(ReadJointRecording(Dance(0, 0, scale), "units.csv", {})),
                HasSubstr("allowed: 0.02 to 1.5 m, with positions in metres"));
    EXPECT_THAT(testing::Refusal(ReadTwinMotion(Dance(0, 0, scale), "units.csv", {}, 1)),
                HasSubstr("the longest bone"));
  }
  EXPECT_TRUE(ReadJointRecording(Dance(0, 0, 0.4), "child.csv", {}));
}

}  // namespace
}  // namespace etude
