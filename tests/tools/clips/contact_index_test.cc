#include "tools/clips/contact_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/reports/support/count_of.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

/// The left foot always stands; the right foot is half a metre up in the second half.
BodyMotion OnOneLeg() {
  BodyMotion motion;
  motion.poses.resize(40);
  for (std::size_t f = 20; f < 40; ++f)
    motion.poses[f][Role::kRightFoot].y = motion.poses[f][Role::kRightAnkle].y = 0.5;
  return motion;
}

TEST(ContactIndex, HasABarWhereAFootStands) {
  const std::string svg = ContactIndexSvg("a < b", OnOneLeg());
  EXPECT_THAT(
      svg, HasSubstr("a &lt; b: left foot is on the floor for 100 % of the time, right foot is on the floor for 48 %"))
      << "the frame before it leaves is fast already";
  EXPECT_EQ(CountOf(svg, "<polyline"), 4) << "height and speed of two feet";
  EXPECT_EQ(CountOf(svg, "<rect x="), 2);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(ContactIndex, OfABodyThatStandsOnItsHandsHasNone) {
  BodyMotion handstand;
  handstand.poses.resize(1);
  for (glm::dvec3& joint : handstand.poses[0].joints) joint.y = 1;
  handstand.poses[0][Role::kLeftHand].y = handstand.poses[0][Role::kRightHand].y = 0;
  const std::string svg = ContactIndexSvg("handstand", handstand);
  EXPECT_EQ(CountOf(svg, "<rect x="), 0);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

}  // namespace
}  // namespace etude
