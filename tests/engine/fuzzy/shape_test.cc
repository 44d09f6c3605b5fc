#include "engine/fuzzy/shape.h"

#include <gtest/gtest.h>

#include <cmath>

namespace etude {
namespace {

TEST(Shape, TakesTheTextbookGradesOfEachKind) {
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 5), 0.5);
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 10), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Triangular{0, 10, 30}, 25), 0.25);
  EXPECT_DOUBLE_EQ(GradeOf(Trapezoidal{0, 10, 20, 40}, 15), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Trapezoidal{0, 10, 20, 40}, 35), 0.25);
  EXPECT_DOUBLE_EQ(GradeOf(Gaussian{90, 25}, 90), 1);
  EXPECT_DOUBLE_EQ(GradeOf(Gaussian{90, 25}, 115), std::exp(-0.5));
  EXPECT_EQ(GradeOf(Singleton{90}, 90), 1);
  EXPECT_EQ(GradeOf(Singleton{90}, std::nextafter(90, 91)), 0);
}

TEST(Shape, HasUprightSidesWhereTwoBreakpointsAreEqual) {
  EXPECT_EQ(GradeOf(Triangular{0, 0, 10}, 0), 1);
  EXPECT_EQ(GradeOf(Triangular{0, 10, 10}, 10), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 5), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 10), 1);
  EXPECT_EQ(GradeOf(Trapezoidal{5, 5, 10, 10}, 10.001), 0);
}

TEST(Shape, HasTheGradeOfACutAtBothItsEnds) {
  const Shape shapes[] = {Triangular{0, 10, 30}, Trapezoidal{-5, 10, 20, 40}, Gaussian{90, 25}};
  for (const Shape& shape : shapes) {
    for (double grade : {0.1, 0.5, 0.9, 1.0}) {
      const Cut cut = CutOf(shape, grade);
      EXPECT_NEAR(GradeOf(shape, cut.low), grade, 1e-12) << shape.index();
      EXPECT_NEAR(GradeOf(shape, cut.high), grade, 1e-12) << shape.index();
      EXPECT_LE(cut.low, cut.high);
    }
  }
}

}  // namespace
}  // namespace etude
