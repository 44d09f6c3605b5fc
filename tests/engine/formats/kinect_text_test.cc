#include "engine/formats/kinect_text.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <sstream>
#include <string>

#include "tests/support/results.h"

namespace etude {
namespace {

/// Returns a row with joint j at (j + 1, 0.5, 2), with or without quaternions.
std::string Row(int frame, bool with_quaternions, const char* separator = " ") {
  std::ostringstream row;
  for (int j = 0; j < 25; ++j) {
    row << (j > 0 ? separator : "") << 0.1 * (j + 1) + frame << separator << 0.5 << separator << 2;
    if (with_quaternions) row << separator << 0 << separator << 0 << separator << 0 << separator << 1;
  }
  return row.str();
}

std::string KinectComplaint(const std::string& text) {
  const auto read = ReadKinectV2Text(text, "k.txt");
  return read ? std::string("(read)") : ToString(read.error());
}

TEST(KinectText, ReadsPlacesWithAndWithoutOrientationsAndWithAnySeparator) {
  for (const bool quaternions : {true, false}) {
    for (const char* separator : {" ", "\t", ",", "; "}) {
      const auto read =
          ReadKinectV2Text(Row(0, quaternions, separator) + "\r\n\n" + Row(1, quaternions, separator), "k.txt");
      ASSERT_TRUE(read) << ToString(read.error());
      ASSERT_EQ(read->size(), 2u);
      EXPECT_EQ((*read)[1][24], glm::dvec3(3.5, 0.5, 2));
    }
  }
}

TEST(KinectText, GivesTheTwentyRolesOfAKinectV1) {
  ASSERT_OK(read, ReadKinectV2Text(Row(0, true), "k.txt"));
  const RolePositions places = PlacesOf((*read)[0]);
  // The roles by the SDK's JointType numbers.
  const std::pair<Role, int> expected[] = {{Role::kHipCentre, 0},       {Role::kSpine, 1},     {Role::kHead, 3},
                                           {Role::kShoulderCentre, 20}, {Role::kLeftHand, 7},  {Role::kRightElbow, 9},
                                           {Role::kLeftHip, 12},        {Role::kLeftFoot, 15}, {Role::kRightKnee, 17},
                                           {Role::kRightFoot, 19}};
  for (const auto& [role, joint] : expected) EXPECT_NEAR(places[Index(role)]->x, 0.1 * (joint + 1), 1e-12);
}

TEST(KinectText, TakesZerosAndNanForMissingJoints) {
  std::string row = Row(0, false);
  row.replace(0, row.find(" 0.2 "), "0 0 0");
  const std::size_t second = row.find("0.2 ");
  row.replace(second, 3, "nan");
  const std::size_t third = row.find("0.4 0.5 2");
  row.replace(third, 9, "-1 -1 -1");
  ASSERT_OK(read, ReadKinectV2Text(row, "k.txt"));
  EXPECT_FALSE((*read)[0][0]);
  EXPECT_FALSE((*read)[0][1]);
  EXPECT_TRUE((*read)[0][2]);
  EXPECT_FALSE((*read)[0][3]);
}

TEST(KinectText, TheNamesOfTheHeadingTellTheJoints) {
  // The joints in the order of the alphabet; joint j is at x = 0.1 (j + 1).
  constexpr const char* kNames[] = {"SpineBase",     "SpineMid",    "Neck",      "Head",          "ShoulderLeft",
                                    "ElbowLeft",     "WristLeft",   "HandLeft",  "ShoulderRight", "ElbowRight",
                                    "WristRight",    "HandRight",   "HipLeft",   "KneeLeft",      "AnkleLeft",
                                    "FootLeft",      "HipRight",    "KneeRight", "AnkleRight",    "FootRight",
                                    "SpineShoulder", "HandTipLeft", "ThumbLeft", "HandTipRight",  "ThumbRight"};
  std::map<std::string, int> alphabet;
  for (int j = 0; j < 25; ++j) alphabet[kNames[j]] = j;
  for (const bool quaternions : {false, true}) {
    std::string heading, merged, row;
    for (const auto& [name, j] : alphabet) {
      merged += (merged.empty() ? "" : ",") + name + (quaternions ? ",,,,,," : ",,");
      for (const char* axis : {"X", "Y", "Z", "qx", "qy", "qz", "qw"}) {
        if (axis[0] != 'q' || quaternions) heading += (heading.empty() ? "" : ",") + name + "_" + axis;
      }
      row += fmt::format("{}{},0.5,2{}", row.empty() ? "" : ",", 0.1 * (j + 1), quaternions ? ",0,0,0,1" : "");
    }
    for (const std::string& line : {heading, merged}) {
      ASSERT_OK(read, ReadKinectV2Text(line + "\n" + row, "k.txt"));
      for (std::size_t j = 0; j < 25; ++j) EXPECT_NEAR((*read)[0][j]->x, 0.1 * static_cast<double>(j + 1), 1e-12) << j;
    }
    const std::string other = "LeftUpLeg" + heading.substr(heading.find('_'));
    EXPECT_TRUE(KinectComplaint(other + "\n" + row).starts_with("k.txt:1: the heading of column 1 is 'LeftUpLeg_X'"));
  }
}

TEST(KinectText, NamesTheLineOfWhatItRefuses) {
  const std::string good = Row(0, true);
  EXPECT_EQ(KinectComplaint(good), "(read)");
  EXPECT_TRUE(KinectComplaint(good + "\n\n# remark\n" + good + " 5\n").starts_with("k.txt:4: found 176 values"))
      << KinectComplaint(good + "\n\n# remark\n" + good + " 5\n");
  EXPECT_TRUE(KinectComplaint(good + "\n" + Row(0, true).replace(0, 3, "0,1")).starts_with("k.txt:2: "));
  EXPECT_TRUE(KinectComplaint(good + "\nx" + good.substr(1)).starts_with("k.txt:2:1: value 1"));
  EXPECT_TRUE(KinectComplaint(good + "\ninf" + good.substr(3)).starts_with("k.txt:2:1: value 1"));
  EXPECT_TRUE(KinectComplaint(Row(0, true) + "\n" + Row(4000, true)).starts_with("k.txt:2: joint 0 is 4000"));
  EXPECT_NE(KinectComplaint("1 2 3\n").find("found 3 values in this row; allowed for a Kinect v2 recording: 75"),
            std::string::npos);
  std::string tiny;
  for (int i = 0; i < 75; ++i) tiny += "0.002 ";
  EXPECT_EQ(KinectComplaint(tiny),
            "k.txt: all joints are within 0.00346 m of the sensor, so the positions are probably not in metres; "
            "allowed: positions in metres");
  EXPECT_EQ(KinectComplaint(""), "k.txt: no rows of numbers");
  EXPECT_EQ(KinectComplaint("# only remarks\n"), "k.txt: no rows of numbers");
}

TEST(KinectText, RefusesTextsThatAreTooLongBeforeReadingThem) {
  const std::string huge((std::size_t{64} << 20) + 1, '1');
  EXPECT_NE(KinectComplaint(huge).find("allowed: at most 67108864"), std::string::npos);
}

}  // namespace
}  // namespace etude
