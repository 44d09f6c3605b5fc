#include <gtest/gtest.h>

#include "engine/base/angles.h"
#include "engine/base/digest.h"
#include "engine/base/names.h"
#include "engine/base/result.h"

namespace etude {
namespace {

TEST(Error, IsToldAsFileLineColumnAndMessage) {
  EXPECT_EQ(ToString(Error{{"a.yaml", 3, 7}, "bad"}), "a.yaml:3:7: bad");
  EXPECT_EQ(ToString(Error{{"a.yaml", 3, 0}, "bad"}), "a.yaml:3: bad");
  EXPECT_EQ(ToString(Error{{"a.yaml", 0, 0}, "bad"}), "a.yaml: bad");
  EXPECT_EQ(ToString(Error{{}, "bad"}), "bad");
  EXPECT_EQ(ToString(Error{{"a\n.yaml", 3, 7}, "found '\x1b[31m\t\x7f'"}), "a .yaml:3:7: found ' [31m  '");
}

TEST(NearestName, FindsTheTypingErrorAndNothingFarAway) {
  const std::vector<std::string> known = {"ccd", "ccd-hinges", "damped-least-squares"};
  EXPECT_EQ(NearestName("cdc", known), "ccd");
  EXPECT_EQ(NearestName("ccd-hinge", known), "ccd-hinges");
  EXPECT_EQ(NearestName("CCD", known), "ccd");
  EXPECT_EQ(NearestName("newton", known), "");
  EXPECT_EQ(NearestName("", known), "");
}

TEST(UnknownName, SaysWhatWasFoundWhatWasMeantAndWhatIsAllowed) {
  EXPECT_EQ(UnknownName("solver", "cdc", std::vector<std::string>{"ccd", "dls"}),
            "unknown solver 'cdc'; did you mean 'ccd'? Allowed: ccd, dls");
  EXPECT_EQ(UnknownName("solver", "newton", std::vector<std::string>{"ccd", "dls"}),
            "unknown solver 'newton'. Allowed: ccd, dls");
}

TEST(Digest, IsXxh3OfTheBytesAddedAndTellsOrdersApart) {
  // XXH3_64bits of the empty input, from the reference implementation's own test vectors.
  EXPECT_EQ(Digest().Hex(), "2d06800538d394c2");
  EXPECT_EQ(Digest().Add("ab").Add("c").Value(), Fingerprint("abc"));
  EXPECT_NE(Digest().Add(1.0).Add(2.0).Hex(), Digest().Add(2.0).Add(1.0).Hex());
}

TEST(AngleBetween, KeepsItsDigitsNearZeroAndPi) {
  const double tiny = 1e-9;
  EXPECT_NEAR(AngleBetween({1, 0, 0}, {1, tiny, 0}), tiny, 1e-18);
  EXPECT_NEAR(AngleBetween({2, 0, 0}, {-3, 0, 0}), kPi, 1e-15);
  EXPECT_NEAR(AngleBetween({0, 0, 5}, {0, 0.1, 0}), kPi / 2, 1e-15);
  EXPECT_EQ(AngleBetween({0, 0, 0}, {1, 0, 0}), 0);
}

}  // namespace
}  // namespace etude
