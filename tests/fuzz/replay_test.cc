#include <gtest/gtest.h>

#include <filesystem>

#include "tests/fuzz/readers/target.h"
#include "tests/support/random_clip.h"

namespace etude::fuzz {
namespace {

class EveryReader : public ::testing::TestWithParam<Target> {};

INSTANTIATE_TEST_SUITE_P(Replay, EveryReader, ::testing::ValuesIn(Targets()), [](const auto& reader) {
  std::string name = reader.param.name;
  std::ranges::replace(name, '-', '_');
  return name;
});

/// Returns the text with one of the typical damages.
std::string Spoilt(std::string text, testing::Dice& dice) {
  if (text.empty()) return text;
  const std::size_t at = dice.Below(text.size());
  switch (dice.Below(5)) {
    case 0:
      return text.substr(0, at);
    case 1:
      text[at] = static_cast<char>(text[at] ^ (1 << dice.Below(8)));
      return text;
    case 2:
      return text.erase(at, 1 + dice.Below(8));
    case 3:
      return text.insert(at, text.substr(dice.Below(text.size()), 1 + dice.Below(40)));
    default:
      text[at] = "-0919eE.,:[]{}\"'#\n\t <>/\xff\x80"[dice.Below(26)];
      return text;
  }
}

TEST_P(EveryReader, TakesEverySeedSpoiltOrNot) {
  const std::vector<std::string> seeds = GetParam().seeds();
  ASSERT_FALSE(seeds.empty());
  testing::Dice dice(1);
  for (const std::string& seed : seeds) {
    GetParam().read(seed);
    for (int i = 0; i < 30; ++i) {
      std::string spoilt = Spoilt(seed, dice);
      if (i % 2 == 0) spoilt = Spoilt(spoilt, dice);
      GetParam().read(spoilt);
    }
  }
}

/// Files that fuzzing found; each once ended the program: tests/fuzz/found/READER.
TEST(Replay, TakesWhatOnceBrokeIt) {
  const std::filesystem::path found = "tests/fuzz/found";
  for (const Target& target : Targets()) {
    if (!std::filesystem::is_directory(found / target.name)) continue;
    for (const std::string& text : FilesOf((found / target.name).string(), "")) target.read(text);
  }
}

TEST(RequireRoundTrip, EndsTheProgramWhereAPromiseIsBroken) {
  const auto read = [](std::string_view text) -> Result<std::string> {
    if (text.size() > 3) return Fail({}, "long");
    return std::string(text);
  };
  const auto same = [](const std::string& text) { return text; };
  RequireRoundTrip("abc", read, same);
  RequireRoundTrip("abcd", read, same);
  EXPECT_DEATH(RequireRoundTrip("abc", read, [](const std::string& text) { return text + "d"; }), "is not read: long");
  EXPECT_DEATH(RequireRoundTrip("a", read, [](const std::string& text) { return text + "d"; }), "the second time");
}

}  // namespace
}  // namespace etude::fuzz
