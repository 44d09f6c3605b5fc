#include "engine/formats/joint_csv.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <vector>

#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<std::string> Split(const std::string& line) {
  std::vector<std::string> parts;
  std::istringstream text(line);
  for (std::string part; std::getline(text, part, ',');) parts.push_back(part);
  return parts;
}

TEST(JointCsv, GivesEveryNumberBackToTheLastBit) {
  BodyMotion motion;
  motion.poses.resize(2);
  for (std::size_t i = 0; i < kRoleCount; ++i) motion.poses[1].joints[i] = glm::dvec3(1.0 / 3, -0.1, 1e-9) * (i + 1.0);
  std::istringstream text(WriteJointCsv(motion));
  std::string headings, first, second;
  std::getline(text, headings);
  std::getline(text, first);
  std::getline(text, second);
  const auto names = Split(headings), values = Split(second);
  ASSERT_EQ(names.size(), 2 + 3 * kRoleCount);
  ASSERT_EQ(values.size(), names.size());
  EXPECT_EQ(names[0] + "," + names[1] + "," + names[2], "frame,time_s,hip_centre_x_m");
  EXPECT_EQ(names.back(), "right_foot_z_m");
  EXPECT_EQ(values[0], "1");
  EXPECT_EQ(std::stod(values[1]), 1 / 30.0);
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_EQ(std::stod(values[2 + 3 * i + axis]), motion.poses[1].joints[i][axis]);
  }
}

TEST(JointCsv, ReadsBackWhatItWrote) {
  BodyMotion motion{.rate_hz = 60, .poses = std::vector<BodyPose>(3)};
  for (std::size_t i = 0; i < kRoleCount; ++i) motion.poses[1].joints[i] = glm::dvec3(1.0 / 3, -0.1, 1e-9) * (i + 1.0);
  ASSERT_OK(read, ReadJointCsv(WriteJointCsv(motion), "m.csv"));
  EXPECT_NEAR(*read->rate_hz, 60, 1e-9);
  ASSERT_EQ(read->frames.size(), 3u);
  for (std::size_t i = 0; i < kRoleCount; ++i) EXPECT_EQ(read->frames[1][i], motion.poses[1].joints[i]);
}

TEST(JointCsv, TakesFewerJointsInAnyOrderAndMissingPlaces) {
  ASSERT_OK(read, ReadJointCsv("head_z_m,head_x_m,head_y_m\n3,1,2\n,1,2\nnan,1,2\n", "m.csv"));
  EXPECT_FALSE(read->rate_hz);
  EXPECT_EQ(read->frames[0][Index(Role::kHead)], glm::dvec3(1, 2, 3));
  EXPECT_FALSE(read->frames[1][Index(Role::kHead)]);
  EXPECT_FALSE(read->frames[2][Index(Role::kHead)]);
  EXPECT_FALSE(read->frames[0][Index(Role::kSpine)]);
  // The last value may be missing; a separator after all values ends the line.
  for (const char* separator : {",", ";", "\t"}) {
    std::string text = "head_x_m,head_y_m,head_z_m\n1,2,\n1,2,3\n1,2,3,\n";
    std::ranges::replace(text, ',', *separator);
    ASSERT_OK(ends, ReadJointCsv(text, "m.csv"));
    EXPECT_FALSE(ends->frames[0][Index(Role::kHead)]);
    EXPECT_EQ(ends->frames[1][Index(Role::kHead)], glm::dvec3(1, 2, 3));
    EXPECT_EQ(ends->frames[2][Index(Role::kHead)], glm::dvec3(1, 2, 3));
  }
}

TEST(JointCsv, RowsAreReadOneByOneAsInTheFile) {
  const std::string heads = "time_s;head_x_m;head_y_m;head_z_m;label\n";
  const JointCsvColumns columns = ReadJointCsv(heads + "0;1;2;3;walk\n", "m.csv")->columns;
  ASSERT_OK(row, ReadJointCsvRow("1600000000,5;1,5;2;3;", columns, "m.csv"));
  EXPECT_EQ(row->time_s, 1600000000.5);
  EXPECT_EQ(row->places[Index(Role::kHead)], glm::dvec3(1.5, 2, 3));
  EXPECT_TRUE(ReadJointCsvRow("1;1;2;3;run", columns, "m.csv")) << "the control";
  EXPECT_EQ(testing::Refusal(ReadJointCsvRow("1;1;far;3;run", columns, "m.csv")),
            "m.csv:2: value 3: found 'far'; allowed: a number, or nan for a missing value");
  EXPECT_EQ(testing::Refusal(ReadJointCsvRow("1;2e9;2;3;run", columns, "m.csv")),
            "m.csv:2: value 2: found 2000000000; allowed: a number within ±1e+09, or nan for a missing value");
}

TEST(JointCsv, TakesTimesInMinutesWhereTheHeadingNamesThem) {
  for (const char* heading : {"time_min", "minutes", "Time (min)"}) {
    const std::string heads = heading + std::string(",head_x_m,head_y_m,head_z_m\n");
    ASSERT_OK(read, ReadJointCsv(heads + "2,1,2,3\n2.001,1,2,3\n2.002,1,2,3\n", "m.csv"));
    EXPECT_NEAR(*read->rate_hz, 1000 / 60.0, 1e-6) << heading;
    EXPECT_NEAR(read->times_s[2], 120.12, 1e-9);
    EXPECT_EQ(read->remark, "the heading of the times names minutes");
    EXPECT_NEAR(ReadJointCsvRow("3,1,2,3", read->columns, "m.csv")->time_s, 180, 1e-9);
  }
  EXPECT_NEAR(*ReadJointCsv("time_s,head_x_m,head_y_m,head_z_m\n2,1,2,3\n2.001,1,2,3\n", "m.csv")->rate_hz, 1000, 1e-6)
      << "the control";
  EXPECT_EQ(testing::Refusal(ReadJointCsv("time_s,time_min,head_x_m,head_y_m,head_z_m\n0,0,1,2,3\n", "m.csv")),
            "m.csv:1: found two columns of times, 'time_s' and 'time_min'; allowed: one");
}

TEST(JointCsv, TakesTabsDecimalCommasQuotesAndTimesSince1970AndLeavesTextsOut) {
  const std::string heads = "time_s,head_x_m,head_y_m,head_z_m,label,head_note\n";
  const std::string rows = "1600000000.5,1.5,-2.25,\"3\",walk,a\n1600000000.75,4.5,5,6,walk,7\n";
  const auto with = [](std::string text, char separator, char point) {
    for (char& c : text) c = c == ',' ? separator : c == '.' ? point : c;
    return text;
  };
  for (const auto& [separator, point] : {std::pair(',', '.'), {';', '.'}, {';', ','}, {'\t', '.'}, {'\t', ','}}) {
    ASSERT_OK(read, ReadJointCsv(with(heads, separator, '.') + with(rows, separator, point), "m.csv"));
    EXPECT_EQ(read->frames[0][Index(Role::kHead)], glm::dvec3(1.5, -2.25, 3)) << separator << point;
    EXPECT_EQ(read->frames[1][Index(Role::kHead)], glm::dvec3(4.5, 5, 6));
    EXPECT_EQ(read->times_s, (std::vector<double>{0, 0.25}));
    EXPECT_EQ(read->remark, std::string("the times begin at 1600000000 s; Etude counts time from the first row; ") +
                                (point == ',' ? "Etude read commas as decimal points; " : "") +
                                "Etude left out columns that contain text: label, head_note");
  }
  const auto read = [](const std::string& text) { return testing::Refusal(ReadJointCsv(text, "m.csv")); };
  // Commas that separate thousands.
  const std::string few = "head_x_m;head_y_m;head_z_m\n";
  EXPECT_EQ(
      read(few + "12.5;1;2\n3.5;1,891;2\n"),
      "m.csv:3:5: value 2: '1,891' has a thousands separator, because other numbers have a decimal point, such as "
      "12.5; allowed: numbers without thousands separators, such as 1234.5");
  EXPECT_EQ(read(few + "1;998;2\n3;1,001;2\n"),
            "m.csv:3:3: value 2: '1,001' has a thousands separator; allowed: numbers without thousands separators, "
            "such as 1234.5");
  for (const char* number : {"1,234.5", "1.234,5", "1,234,567"}) {
    EXPECT_EQ(
        read(few + "1;2;3\n1;" + number + ";3\n"),
        fmt::format("m.csv:3:3: value 2: found '{}'; allowed: a number within ±1e+09, without a thousands separator, "
                    "or nan for a missing value",
                    number));
  }
  EXPECT_TRUE(ReadJointCsv(few + "1;865,636;2\n0;1,234;2\n", "m.csv")) << "the control: each column is alike";
  EXPECT_TRUE(ReadJointCsv(few + "0,5;1,234;2\n1.5;1;2\n", "m.csv")) << "0,5 is a decimal comma";
  EXPECT_EQ(read("head_x_m,head_y_m,head_z_m\n0,1,0,2,0,3\n"),
            "m.csv:1: 3 headings, but 6 columns; if the numbers have decimal commas, separate the columns by "
            "semicolons or tabs");
  EXPECT_EQ(read("head_x_m,head_y_m,head_z_m\n1,far,2\n"),
            "m.csv:2: column head_y_m: found 'far'; allowed: a number, or nan for a missing value");
  // A hundred text columns are ignored; with more, the table is refused.
  const auto texts = [&](int count) {
    std::string text = "head_x_m,head_y_m,head_z_m", row = "\n1,2,3";
    for (int i = 0; i < count; ++i) {
      text += fmt::format(",note_{}", i);
      row += ",x";
    }
    const auto some = ReadJointCsv(text + row + "\n", "m.csv");
    return some ? some->remark : ToString(some.error());
  };
  EXPECT_THAT(texts(100),
              ::testing::EndsWith("Etude left out columns that contain text: note_0, note_1, note_2, note_3, note_4, "
                                  "note_5, note_6, note_7, …"));
  EXPECT_THAT(texts(101), ::testing::HasSubstr("value 104: found 'x'"));
  EXPECT_NE(read("head_x_m,head_y_m,head_z_m\n1,2e9,2\n").find("within ±1e+09"), std::string::npos);
}

TEST(JointCsv, RefusesUnknownHeadingsHalfJointsAndRaggedRows) {
  const auto complaint = [](const char* text) {
    const auto read = ReadJointCsv(text, "m.csv");
    return read ? std::string("(read)") : ToString(read.error());
  };
  EXPECT_NE(complaint("hed_x_m,head_y_m,head_z_m\n1,2,3\n").find("head_x_m"), std::string::npos);
  EXPECT_EQ(complaint("head_x_m,head_y_m\n1,2\n"),
            "m.csv:1: 'head' needs columns for x, y and z, but some are missing");
  EXPECT_EQ(complaint("head_x_m,head_y_m,head_z_m,head_x_m\n1,2,3,4\n"), "m.csv:1: heading 'head_x_m' twice");
  std::string blank = "head_x_m,head_y_m,head_z_m\n";
  for (int i = 0; i <= 1'000'000; ++i) blank += ",,\n";
  EXPECT_EQ(complaint(blank.c_str()), "m.csv: found 1000001 rows; allowed: at most 1000000");
  const std::string timed = "time_s,head_x_m,head_y_m,head_z_m\n";
  EXPECT_EQ(complaint((timed + "0.2,1,2,3\n0.1,1,2,3\n0,1,2,3\n").c_str()),
            "m.csv:3: the time 0.1 s follows 0.2 s; allowed: times that do not decrease");
  EXPECT_EQ(complaint((timed + "1,1,2,3\n1,1,2,3\n").c_str()), "(read)");
}

}  // namespace
}  // namespace etude
