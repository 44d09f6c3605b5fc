#include <gtest/gtest.h>

#include <algorithm>

#include "engine/base/angles.h"
#include "engine/base/digest.h"
#include "engine/base/directions.h"
#include "engine/base/names.h"
#include "engine/base/result.h"

namespace etude {
namespace {

TEST(Error, ShowsNoControlByteOfAFileOrAMessage) {
  EXPECT_EQ(ToString(Error{{"a\n.yaml", 3, 7}, "found '\x1b[31m\t\x7f'"}), "a .yaml:3:7: found ' [31m  '");
  EXPECT_EQ(ToString(Error{{}, std::string("a\0b é", 6)}), "a b é") << "every control byte, and no byte of a letter";
}

// The textbook's recursion without a table: the cost is the least over all last edits.
int Edits(std::string_view a, std::string_view b) {
  if (a.empty() || b.empty()) return static_cast<int>(a.size() + b.size());
  const std::string_view a1 = a.substr(0, a.size() - 1), b1 = b.substr(0, b.size() - 1);
  int least = std::min({Edits(a1, b) + 1, Edits(a, b1) + 1, Edits(a1, b1) + (a.back() == b.back() ? 0 : 1)});
  if (!a1.empty() && !b1.empty() && a.back() == b1.back() && a1.back() == b.back()) {
    least = std::min(least, Edits(a1.substr(0, a1.size() - 1), b1.substr(0, b1.size() - 1)) + 1);
  }
  return least;
}

TEST(NearestName, IsTheFirstOfTheFewestEdits) {
  std::vector<std::string> words;
  for (int i = 0; i < 81; ++i) {
    std::string word;
    for (int k = 0, rest = i; k < 4; ++k, rest /= 3) word += "abc"[rest % 3];
    words.push_back(word.substr(0, 2 + i % 3));
  }
  const std::vector<std::string> few = {"bcab", "ccba", "acac"};
  int found = 0;
  for (const std::vector<std::string>& known : {words, few}) {
    for (const std::string& name : words) {
      std::string nearest;
      int least = 2 + static_cast<int>(name.size()) / 3;  // one edit, plus one per three letters
      for (const std::string& word : known) {
        if (Edits(name, word) < least) least = Edits(name, nearest = word);
      }
      EXPECT_EQ(NearestName(name, known), nearest) << name;
      found += nearest.empty() ? 0 : 1;
    }
  }
  EXPECT_GT(found, 90);
  EXPECT_LT(found, 160);
}

TEST(UnknownName, IsShownUpToSixtyLetters) {
  EXPECT_EQ(UnknownName("solver", std::string(61, 'x'), std::vector<std::string>{"ccd"}),
            "unknown solver '" + std::string(60, 'x') + "'. Allowed: ccd");
}

TEST(Quote, ShowsWhatAReaderSees) {
  EXPECT_EQ(Quote("two words"), "'two words'");
  EXPECT_EQ(Quote("\tx\x7f"), "'?x?'");
  EXPECT_EQ(Quote("左ひじ"), "'左ひじ'");
  EXPECT_EQ(Quote("Épaule 😀"), "'Épaule 😀'");
  EXPECT_EQ(Quote("\x83\x6a\xff\xc3"), "'?j?\?'") << "no UTF-8";
  EXPECT_EQ(Quote("a\u202eb\u0085"), "'a?\?\?b?\?'") << "turns the direction of writing; controls";
  EXPECT_EQ(Quote("\xc0\xaf"), "'?\?'") << "written longer than need be";
  std::string many;
  for (int i = 0; i < 41; ++i) many += "腕";
  EXPECT_EQ(Quote(many), "'" + many.substr(0, 120) + "…'");
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
  EXPECT_EQ(AngleBetween({0, 0, 0}, {-1, -2, -3}), 0) << "a product that is −0";
}

}  // namespace
}  // namespace etude
