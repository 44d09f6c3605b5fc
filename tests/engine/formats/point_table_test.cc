#include "engine/formats/point_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/results.h"

namespace etude {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Three points in two rows: point p has (p, 10 + p, 20 + p) in the first row, and 100 more in the second.
constexpr const char* kRows = "0,10,20,1,11,21,2,12,22\n100,110,120,101,111,121,102,112,122\n";

std::string Complaint(const std::string& text) {
  EXPECT_TRUE(IsPointTable(text)) << text;
  const auto read = ReadPointTable(text, "t.csv");
  EXPECT_FALSE(read) << text;
  return read ? "" : ToString(read.error());
}

TEST(PointTable, IsTheSameInEveryFormOfHeadings) {
  for (const std::string heading : {"a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z", "a.X,a.Y,a.Z,b.X,b.Y,b.Z,c.X,c.Y,c.Z",
                                    "x_a,y_a,z_a,x_b,y_b,z_b,x_c,y_c,z_c", "aX,aY,aZ,bX,bY,bZ,cX,cY,cZ",
                                    "a pos x, a pos y, a pos z, b pos x, b pos y, b pos z, c pos x, c pos y, c pos z",
                                    "a:x,a:y,a:z,b:x,b:y,b:z,c:x,c:y,c:z"}) {
    const std::string text = heading + "\n" + kRows;
    ASSERT_TRUE(IsPointTable(text)) << heading;
    ASSERT_OK(read, ReadPointTable(text, "t.csv"));
    const MarkerMotion& markers = read->rows.markers;
    EXPECT_THAT(markers.names, ElementsAre("a", "b", "c")) << heading;
    EXPECT_FALSE(read->has_unit);
    EXPECT_FALSE(read->has_rate);
    EXPECT_EQ(markers.remark, "");
    ASSERT_EQ(markers.frames.size(), 2u);
    for (int p = 0; p < 3; ++p) {
      EXPECT_EQ(markers.frames[0][p], glm::dvec3(p, 10 + p, 20 + p));
      EXPECT_EQ(markers.frames[1][p], glm::dvec3(100 + p, 110 + p, 120 + p));
    }
  }
  ASSERT_OK(numbered, ReadPointTable(std::string("x0,y0,z0,x1,y1,z1,x2,y2,z2\n") + kRows, "t.csv"));
  EXPECT_THAT(numbered->rows.markers.names, ElementsAre("0", "1", "2"));
}

TEST(PointTable, TakesUnitsTimesFramesAndGapsFromItsColumns) {
  // As pandas writes it: with an index without a heading. The axes are in another order, and one value is missing.
  ASSERT_OK(read,
            ReadPointTable(",time (ms),a_z [mm],a_y [mm],a_x [mm],b_x [mm],b_y [mm],b_z [mm],c_x [mm],c_y [mm],c_z "
                           "[mm],b score\n7,0,3,2,1,4,5,6,7,8,9,0.5\n8,40,3,2,1,4,,6,7,8,9,0.5\n",
                           "t.csv"));
  const MarkerMotion& markers = read->rows.markers;
  EXPECT_TRUE(read->has_unit);
  EXPECT_TRUE(read->has_rate);
  EXPECT_EQ(markers.metres_per_unit, 0.001);
  EXPECT_NEAR(glm::distance(*markers.frames[0][0], glm::dvec3(0.001, 0.002, 0.003)), 0, 1e-15);
  EXPECT_TRUE(markers.frames[0][1]);
  EXPECT_FALSE(markers.frames[1][1]);
  EXPECT_THAT(read->rows.times_s, ElementsAre(0, 0.04));
  EXPECT_THAT(read->rows.numbers, ElementsAre(7, 8));
  EXPECT_EQ(markers.remark, "Etude left out columns that are no positions: b_score");
  ASSERT_OK(laid, LayOnClock(read->rows, "t.csv"));
  EXPECT_NEAR(laid->rate_hz, 25, 1e-9);
}

TEST(PointTable, LeavesOtherQuantitiesOut) {
  const std::string text = std::string("a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z,a_vel_x,a_vel_y,a_vel_z,rotation_b_x\n") +
                           "0,10,20,1,11,21,2,12,22,5,5,5,90\n";
  ASSERT_OK(read, ReadPointTable(text, "t.csv"));
  EXPECT_THAT(read->rows.markers.names, ElementsAre("a", "b", "c"));
  EXPECT_THAT(read->rows.markers.remark, HasSubstr("a_vel_x, a_vel_y, a_vel_z, rotation_b_x"));
}

TEST(PointTable, HasPeopleInSeparateFiles) {
  const std::string heading = "person,a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z\n", place = ",0,10,20,1,11,21,2,12,22\n";
  EXPECT_EQ(Complaint(heading + "4" + place + "5" + place + "4" + place),
            "t.csv:3: the column 'person' goes from 4 to 5; allowed: the rows of one person");
  EXPECT_TRUE(ReadPointTable(heading + "4" + place + "4" + place, "t.csv"));
  EXPECT_TRUE(ReadPointTable(heading + "4" + place + "5" + place + "6" + place, "t.csv")) << "the column counts rows";
}

TEST(PointTable, IsRefusedWithTheReason) {
  const std::string whole = "a_x,a_y,a_z,b_x,b_y,b_z,c_x,c_y,c_z";
  EXPECT_EQ(Complaint(whole + ",d_x,d_y\n0,0,0,0,0,0,0,0,0,0,0\n"),
            "t.csv:1: found no z of the point 'd'; allowed: x, y and z of each point");
  EXPECT_EQ(Complaint(whole + ",a_x\n0,0,0,0,0,0,0,0,0,0\n"), "t.csv:1: found x of the point 'a' twice");
  EXPECT_EQ(Complaint(whole + ",d_x_mm,d_y_mm,d_z_mm\n0,0,0,0,0,0,0,0,0,0,0,0\n"),
            "t.csv:1: found the headings 'a_x' and 'd_x_mm'; allowed: the same unit in all headings");
  EXPECT_EQ(Complaint(whole + ",time\n0,0,0,0,0,0,0,0,0,12:30\n"),
            "t.csv:2: column 'time': found '12:30'; allowed: a number, or nan for a missing value");
  EXPECT_THAT(Complaint(whole + "\n0,0,0,2e9,0,0,0,0,0\n"), HasSubstr("t.csv:2: x of 'b': found 2000000000; allowed"));
  // Two points, points without z, or one column a quantity are no such table.
  for (const char* other : {"a_x,a_y,a_z,b_x,b_y,b_z\n", "a_x,a_y,b_x,b_y,c_x,c_y\n", "frame,x,y,z\n", "1,2,3\n", ""}) {
    EXPECT_FALSE(IsPointTable(other)) << other;
  }
}

}  // namespace
}  // namespace etude
