#include "tools/sensor_fit/recording.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

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
