#include "engine/formats/motion_bids.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "sim/choreography/move.h"
#include "tests/support/replaced.h"
#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::HasSubstr;

const std::array<std::string, 2> kFiles = {"m.tsv", "c.tsv"};

std::map<std::string, std::string> Written(const BodyMotion& motion) {
  std::map<std::string, std::string> files;
  for (const auto& [name, bytes] : WriteMotionBids(motion, "a clap_1", "9")) files[name] = bytes;
  return files;
}

const std::string kStem = "sub-01/motion/sub-01_task-aclap1_tracksys-etude";

TEST(MotionBids, ReferenceFramesAreThoseOfItsPositions) {
  const std::string heads = "name\tcomponent\ttype\ttracked_point\tunits\treference_frame\n";
  const std::string rows = "a_x\tx\tPOS\ta\tm\tlab\na_w\tquat_w\tORNT\ta\tn/a\tsensor\nb_x\tx\tPOS\tb\tm\tn/a\n";
  EXPECT_EQ(FramesOfBids(heads + rows), (std::set<std::string, std::less<>>{"lab"}));
  EXPECT_TRUE(FramesOfBids("name\ttype\na_x\tPOS\n").empty());
}

TEST(MotionBids, SpatialAxesNameTheUpAxis) {
  EXPECT_EQ(UpOfSpatialAxes("LSA"), glm::dvec3(0, 1, 0));
  EXPECT_EQ(UpOfSpatialAxes("ALS"), glm::dvec3(0, 0, 1));
  EXPECT_EQ(UpOfSpatialAxes("IRP"), glm::dvec3(-1, 0, 0));
  for (const char* const other : {"", "n/a", "LS", "LSAX", "LLS", "ASI", "LS_", "lsa"}) {
    EXPECT_FALSE(UpOfSpatialAxes(other)) << other;
  }
}

TEST(MotionBids, IsReadBackToTheLastPrintedDigit) {
  const BodyMotion motion = LoadBuiltinMove("clap").value().motion;
  auto files = Written(motion);
  ASSERT_EQ(files.size(), 6u);
  const auto read =
      ReadMotionBids(files[kStem + "_motion.tsv"], files[kStem + "_channels.tsv"], {motion.rate_hz}, kFiles);
  ASSERT_TRUE(read) << ToString(read.error());
  EXPECT_EQ(read->rate_hz, motion.rate_hz);
  ASSERT_EQ(read->frames.size(), motion.poses.size());
  for (const Role role : AllRoles()) {
    ASSERT_EQ(read->names[Index(role)], RoleName(role));
    for (std::size_t f = 0; f < motion.poses.size(); ++f) {
      for (int axis = 0; axis < 3; ++axis) {
        const double printed = std::round(1e6 * motion.poses[f][role][axis]);
        EXPECT_EQ(std::round(1e6 * (*read->frames[f][Index(role)])[axis]), printed);
      }
    }
  }
}

const std::string kChannels =
    "name\ttype\tcomponent\ttracked_point\tunits\n"
    "a_x\tPOS\tx\ta\tmm\na_z\tPOS\tz\ta\tcm\na_y\tPOS\ty\ta\tm\nq\tORNT\tx\ta\trad\n";

TEST(MotionBids, OfOthersHasItsUnitsItsOrderAndItsGaps) {
  const auto read = ReadMotionBids("1000\t50\t2\t9\nn/a\t50\t2\tn/a\n", kChannels, {50}, kFiles);
  ASSERT_TRUE(read) << ToString(read.error());
  EXPECT_EQ(read->frames[0][0], glm::dvec3(1, 2, 0.5));
  EXPECT_FALSE(read->frames[1][0]);
  EXPECT_EQ(read->remark, "Etude left out 1 channels that are not positions");
}

TEST(MotionBids, LatencyIsTheClockAndMissingValuesAreGaps) {
  std::string rows, channels = kChannels + "t\tLATENCY\tn/a\tn/a\ts\n";
  for (int k = 0; k < 60; ++k) {
    if (k >= 20 && k < 26) continue;
    rows += fmt::format("{}\t50\t2\t9\t{:.4f}\n", k == 10 ? -9999 : 1000 + k, k / 50.0);
  }
  ASSERT_OK(read, ReadMotionBids(rows, channels, {.rate_hz = 60, .missing = "-9999"}, kFiles));
  EXPECT_EQ(read->rate_hz, 50);
  ASSERT_EQ(read->frames.size(), 60u);
  for (int k = 0; k < 60; ++k) {
    const auto& place = read->frames[static_cast<std::size_t>(k)][0];
    ASSERT_EQ(place.has_value(), k != 10 && (k < 20 || k >= 26)) << k;
    EXPECT_EQ(place.value_or(glm::dvec3((1000 + k) * 0.001, 2, 0.5)), glm::dvec3((1000 + k) * 0.001, 2, 0.5));
  }
  EXPECT_THAT(read->remark, HasSubstr("SamplingFrequency states 60 Hz, but the times in the channel LATENCY give 50 "
                                      "Hz"));
  EXPECT_THAT(read->remark, HasSubstr("6 of 60 frames are missing"));
  // A missing time is refused.
  rows.replace(rows.rfind('\t') + 1, 6, "-9999");
  EXPECT_THAT(testing::Refusal(ReadMotionBids(rows, channels, {.rate_hz = 60, .missing = "-9999"}, kFiles)),
              HasSubstr("m.tsv:54: this row has no time, but other rows have one"));
  // If 0 marks missing values, a position is missing only if all three coordinates are 0. A word may also mark gaps.
  const auto zero = ReadMotionBids("0\t0\t0\t1\n0\t100\t0\t1\n", kChannels, {50, "0"}, kFiles);
  EXPECT_FALSE(zero->frames[0][0]);
  EXPECT_EQ(zero->frames[1][0], glm::dvec3(0, 0, 1));
  EXPECT_FALSE(ReadMotionBids("lost\t0\t0\t1\n1\t2\t3\t4\n", kChannels, {50, "lost"}, kFiles)->frames[0][0]);
  EXPECT_FALSE(ReadMotionBids("lost\t0\t0\t1\n1\t2\t3\t4\n", kChannels, {50}, kFiles)) << "the control";
}

TEST(MotionBids, SaysWhatIsWrong) {
  const auto reason = [](const std::string& rows, const std::string& channels) {
    const auto read = ReadMotionBids(rows, channels, {50}, kFiles);
    return read ? "read" : ToString(read.error());
  };
  const auto with = [](const char* from, const char* to) { return testing::Replaced(kChannels, from, to); };
  const std::string row = "1\t2\t3\t4\n";
  EXPECT_EQ(reason(row, kChannels), "read") << "the control";
  EXPECT_THAT(reason("1\t2\n", kChannels), HasSubstr("m.tsv:1: 2 columns, but 4 channels in c.tsv"));
  EXPECT_THAT(reason(row, with("units", "unit")), HasSubstr("c.tsv:1: no column units"));
  EXPECT_THAT(reason(row, with("mm", "furlong")),
              HasSubstr("c.tsv:2: found units 'furlong'; allowed for channels of type POS: m, cm, mm, in, ft"));
  EXPECT_THAT(reason(row, with("\tx\t", "\tw\t")), HasSubstr("found component 'w'; allowed for channels of type POS: "
                                                             "x, y, z"));
  EXPECT_THAT(reason(row, with("\ty\t", "\tz\t")), HasSubstr("c.tsv:4: the point 'a' has two channels for z"));
  EXPECT_THAT(reason("1\t2\t3\n", with("a_y\tPOS\ty\ta\tm\n", "")),
              HasSubstr("'a' needs channels for x, y and z, but some are missing"));
  EXPECT_THAT(reason("x\ty\tz\tq\n" + row, kChannels),
              HasSubstr("found a line with column names; allowed: only rows of numbers"));
}

}  // namespace
}  // namespace etude
