#include "engine/formats/trc.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sstream>
#include <vector>

#include "tests/support/results.h"

namespace etude {
namespace {

std::vector<std::string> SplitAtTabs(const std::string& line) {
  std::vector<std::string> parts(1);
  for (const char c : line) {
    if (c == '\t') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

/// Returns two frames: joint i is at (i, i + 0.25, −i) metres, 1 mm higher in the second.
BodyMotion Steps() {
  BodyMotion motion;
  for (int frame = 0; frame < 2; ++frame) {
    BodyPose& pose = motion.poses.emplace_back();
    for (std::size_t i = 0; i < kRoleCount; ++i) {
      const double x = static_cast<double>(i);
      pose.joints[i] = {x, x + 0.25 + 0.001 * frame, -x};
    }
  }
  return motion;
}

// The layout that OpenSim reads: three lines about the file, two of headings, an empty one, then frames.
TEST(Trc, HasTheHeadingsAndColumnsThatOpenSimWants) {
  std::istringstream text(WriteTrc(Steps(), "steps"));
  std::vector<std::string> lines;
  for (std::string line; std::getline(text, line);) lines.push_back(line);
  ASSERT_EQ(lines.size(), 6u + 2u);
  EXPECT_EQ(lines[0], "PathFileType\t4\t(X/Y/Z)\tsteps.trc");
  EXPECT_EQ(lines[1],
            "DataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\tOrigDataRate\tOrigDataStartFrame\tOrigNumFrames");
  EXPECT_EQ(lines[2], "30\t30\t2\t20\tmm\t30\t1\t2");
  EXPECT_EQ(lines[5], "");
  const auto names = SplitAtTabs(lines[3]), axes = SplitAtTabs(lines[4]), second = SplitAtTabs(lines[7]);
  ASSERT_EQ(second.size(), 2 + 3 * kRoleCount);
  ASSERT_EQ(axes.size(), second.size());
  EXPECT_EQ(names[0], "Frame#");
  EXPECT_EQ(names[1], "Time");
  EXPECT_EQ(second[0], "2");
  EXPECT_EQ(second[1], "0.033333");
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const double x = static_cast<double>(i);
    EXPECT_EQ(names[2 + 3 * i], RoleName(AllRoles()[i]));
    EXPECT_EQ(axes[2 + 3 * i], "X" + std::to_string(i + 1));
    EXPECT_EQ(std::stod(second[2 + 3 * i]), 1000 * x);
    EXPECT_EQ(std::stod(second[3 + 3 * i]), 1000 * x + 251);
    EXPECT_EQ(std::stod(second[4 + 3 * i]), -1000 * x);
  }
}

TEST(Trc, KeepsItsFirstLineWhateverTheName) {
  EXPECT_TRUE(
      WriteTrc(Steps(), "a\nb\tc \xC3\xA9").starts_with("PathFileType\t4\t(X/Y/Z)\ta_b_c \xC3\xA9.trc\nDataRate"));
}

/// Returns a still marker at 50 Hz in a file whose DataRate is `data_rate`; `unit_s` is the unit of column Time.
std::string AtFiftyHertz(int data_rate, int frames, double unit_s = 1) {
  std::string text = fmt::format(
      "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n{}\t{}\t1\tm\nFrame#\tTime\tA\n\n",
      data_rate, frames);
  for (int t = 0; t < frames; ++t) text += fmt::format("{}\t{:.2f}\t1\t2\t3\n", t + 1, (7 + 0.02 * t) / unit_s);
  return text;
}

TEST(ReadTrc, TakesTheRateOfItsTimesWhereDataRateIsAnother) {
  ASSERT_OK(read, ReadTrc(AtFiftyHertz(100, 60), "a.trc"));
  EXPECT_EQ(read->rate_hz, 50);
  EXPECT_EQ(read->start_s, 7) << "the first time of the file";
  EXPECT_EQ(read->remark, "DataRate states 100 Hz, but the times in the column Time give 50 Hz, which is used");
  const auto alike = ReadTrc(AtFiftyHertz(51, 60), "a.trc"), brief = ReadTrc(AtFiftyHertz(100, 20), "a.trc");
  EXPECT_EQ(alike->rate_hz, 50) << "at the end they are a frame apart";
  EXPECT_EQ(brief->rate_hz, 100) << "so few times tell no rate";
  EXPECT_EQ(brief->remark,
            "DataRate states 100 Hz, which is used, but the times in the column Time give 50 Hz (from only 20 rows)");
}

TEST(ReadTrc, SaysWhereFrameNumbersJumpAndTimesDoNot) {
  std::string text = AtFiftyHertz(50, 60);
  EXPECT_EQ(ReadTrc(text, "a.trc")->remark, "");
  for (int t = 60; t > 30; --t) {
    const std::string old = fmt::format("\n{}\t", t);
    text.replace(text.rfind(old), old.size(), fmt::format("\n{}\t", t + 20));
  }
  EXPECT_EQ(ReadTrc(text, "a.trc")->remark,
            "the frame numbers go from 30 to 51, but the times in the column Time advance by 0.02 s, the duration of 1 "
            "frames; Etude uses the times");
}

TEST(ReadTrc, RefusesARowThatLacksACoordinate) {
  std::string text = AtFiftyHertz(50, 60);
  text.replace(text.find("\t1\t2\t3\n"), 7, "\t1\t2\n");
  EXPECT_EQ(testing::Refusal(ReadTrc(text, "a.trc")),
            "a.trc:6: found 2 coordinates; allowed: a multiple of 3 (X, Y and Z of each marker)");
}

TEST(ReadTrc, TakesTheRateOfItsTimesWhereDataRateIsZero) {
  ASSERT_OK(read, ReadTrc(AtFiftyHertz(0, 60), "a.trc"));
  EXPECT_EQ(read->rate_hz, 50);
  EXPECT_EQ(read->remark, "");
  EXPECT_EQ(testing::Refusal(ReadTrc(AtFiftyHertz(0, 1), "a.trc")),
            "a.trc:3: DataRate is 0, and all rows have the same time");
  std::string timeless = AtFiftyHertz(0, 2);
  for (const char* time : {"7.00", "7.02"}) timeless.erase(timeless.find(time), 4);
  EXPECT_EQ(testing::Refusal(ReadTrc(timeless, "a.trc")), "a.trc:3: DataRate is 0, and the rows have no times");
}

TEST(ReadTrc, TakesTheFirstFrameAndTheAxesFromTheLineThatHasThem) {
  const std::string text = AtFiftyHertz(50, 60);
  const std::size_t blank = text.find("\n\n") + 1;
  const auto with = [&](const std::string& line) { return text.substr(0, blank) + line + text.substr(blank); };
  ASSERT_OK(wanted, ReadTrc(with("\t\tX1\tY1\tZ1\n"), "a.trc"));
  ASSERT_OK(none, ReadTrc(text.substr(0, blank) + text.substr(blank + 1), "a.trc"));
  EXPECT_EQ(none->frames, wanted->frames) << "a file without that line";
  EXPECT_EQ(ReadTrc(with("\tx1\ty1\tz1\t\n"), "a.trc")->frames, wanted->frames);
  EXPECT_EQ(testing::Refusal(ReadTrc(with("\t\tX1\tZ1\tY1\n"), "a.trc")),
            "a.trc:5:3: found axes in the order XZY; allowed: X, Y, Z of each marker");
}

TEST(ReadTrc, RefusesAnyMarkersAxesInAnotherOrder) {
  const auto read = [](const std::string& axes) {
    return ReadTrc(
        "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n50\t2\t2\tm\n"
        "Frame#\tTime\tA\t\t\tB\n" +
            axes + "\n\n1\t0\t1\t2\t3\t4\t5\t6\n2\t.02\t1\t2\t3\t4\t5\t6\n",
        "a.trc");
  };
  EXPECT_EQ(testing::Refusal(read("\t\tX1\tY1\tZ1\tX2\tZ2\tY2")),
            "a.trc:5:12: found axes in the order XZY; allowed: X, Y, Z of each marker");
  EXPECT_EQ(testing::Refusal(read("\t\tX\tY\tZ\tY\tX\tZ")),
            "a.trc:5:9: found axes in the order YXZ; allowed: X, Y, Z of each marker");
  // The controls: labels that are complete, missing, or of some markers only.
  for (const char* axes : {"\t\tX1\tY1\tZ1\tX2\tY2\tZ2", "\t\tx\ty\tz\tx\ty\tz", "\t\tX1\tY1\tZ1",
                           "\t\tX1\tY1\t\tX2\tY2\tZ2", "\t\tX1\tY1\tZ1\t\tX2\tY2\tZ2", ""}) {
    ASSERT_OK(taken, read(axes));
    EXPECT_EQ(*taken->frames[1][1], glm::dvec3(4, 5, 6)) << axes;
  }
}

TEST(ReadTrc, RefusesShortRowsOfMoreMarkersThanFitIntoMemory) {
  std::string text = "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tNumFrames\tNumMarkers\tUnits\n50\t40000\t1000\tm\n";
  text += "Frame#\tTime";
  for (int i = 0; i < 1000; ++i) text += fmt::format("\tM{}\t\t", i);
  text += "\n\n";
  for (int t = 0; t < 40'000; ++t) text += "1\t0\n";
  EXPECT_EQ(testing::Refusal(ReadTrc(text, "a.trc")),
            "a.trc:5: 40000 rows of 1000 markers take 1280 MB; allowed: at most 1000 MB");
}

TEST(ReadTrc, TakesTimesInMillisecondsWhereOnlyTheyAgreeWithDataRate) {
  ASSERT_OK(read, ReadTrc(AtFiftyHertz(50, 60, 0.001), "a.trc"));
  EXPECT_EQ(read->rate_hz, 50);
  EXPECT_EQ(read->frames.size(), 60u);
  EXPECT_NEAR(read->start_s.value_or(0), 7, 1e-9);
  EXPECT_EQ(read->remark, "the column Time is taken as milliseconds, because the rows then have the DataRate of 50 Hz");
  EXPECT_EQ(ReadTrc(AtFiftyHertz(50, 60), "a.trc")->remark, "");
}

TEST(ReadTrc, TakesDecimalCommasAndSaysSo) {
  std::string commas = WriteTrc(Steps(), "steps");
  for (std::size_t i = commas.find("Frame#"); i < commas.size(); ++i) {
    if (commas[i] == '.') commas[i] = ',';
  }
  ASSERT_OK(pointed, ReadTrc(WriteTrc(Steps(), "steps"), "a.trc"));
  ASSERT_OK(read, ReadTrc(commas, "a.trc"));
  EXPECT_EQ(read->frames, pointed->frames);
  EXPECT_EQ(read->remark, "Etude read commas as decimal points");
  EXPECT_EQ(pointed->remark, "");
  // A control: a comma between thousands, beside times with decimal points.
  std::string thousands = WriteTrc(Steps(), "steps");
  thousands.replace(thousands.rfind('\t') + 1, std::string::npos, "1,891\n");
  EXPECT_THAT(testing::Refusal(ReadTrc(thousands, "a.trc")),
              ::testing::HasSubstr("'1,891' has a thousands separator, because other numbers have a decimal point"));
}

TEST(ReadTrc, KnowsUnitsByTheirNamesInAnyCase) {
  const auto metres = [](const std::string& unit) {
    std::string text = AtFiftyHertz(50, 60);
    text.replace(text.find("\tm\n"), 3, "\t" + unit + "\n");
    const auto read = ReadTrc(text, "a.trc");
    return read ? read->metres_per_unit : 0;
  };
  EXPECT_EQ(metres("Meters"), 1);
  EXPECT_EQ(metres("centimetres"), 0.01);
  EXPECT_EQ(metres("MM"), 0.001);
  EXPECT_EQ(metres("in"), 0.0254);
  EXPECT_EQ(metres("feet"), 0.3048);
  EXPECT_EQ(metres("furlong"), 0);
}

TEST(ReadTrc, ReadsWhatWasWrittenAndWhatWasNotSeen) {
  MarkerMotion motion{.rate_hz = 60, .names = {"RHip", "L Toe"}, .frames = {}};
  motion.frames = {
      {glm::dvec3(1, 2, -3), std::nullopt}, {glm::dvec3(0.5), glm::dvec3(-0.25, 0, 1)}, {std::nullopt, glm::dvec3(1)}};
  ASSERT_OK(back, ReadTrc(WriteTrc(motion, "two"), "two.trc"));
  EXPECT_EQ(back->names, motion.names);
  EXPECT_EQ(back->rate_hz, 60);
  EXPECT_EQ(back->frames, motion.frames);
  ASSERT_OK(body, ReadTrc(WriteTrc(Steps(), "steps"), "steps.trc"));
  EXPECT_EQ(body->names.size(), kRoleCount);
  EXPECT_NEAR(body->frames[1][3]->y, 3.251, 1e-9);
}

TEST(ReadTrc, TakesOtherProgramsFiles) {
  const std::string text =
      "PathFileType\t4\t(X/Y/Z)\ta.trc\r\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\r\n100\t100\t1\t2\tm\r\n"
      "Frame#\tTime\tA\t\t\tB\t\t\r\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\r\n1\t0.0\t1\t2\t3\tnan\tnan\tnan\r\n";
  ASSERT_OK(motion, ReadTrc(text, "a.trc"));
  EXPECT_EQ(motion->frames[0][0], glm::dvec3(1, 2, 3));
  EXPECT_FALSE(motion->frames[0][1]);
  std::string far = text;
  far.replace(far.find("nan\tnan\tnan"), 11, "0\t1e6\t0");
  EXPECT_TRUE(ReadTrc(far, "a.trc")->frames[0][1]);
  far.replace(far.find("1e6"), 3, "2e6");
  EXPECT_FALSE(ReadTrc(far, "a.trc")->frames[0][1]) << "what could not be written and read again";
}

}  // namespace
}  // namespace etude
