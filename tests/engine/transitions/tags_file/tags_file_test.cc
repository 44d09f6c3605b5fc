#include "engine/transitions/tags_file/tags_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine/transitions/library/bridge_frames.h"
#include "engine/transitions/library/in_betweens.h"
#include "tests/engine/transitions/prints.h"
#include "tests/support/kept_lines.h"
#include "tests/support/replaced.h"

namespace etude {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::Replaced;

BridgeTags SomeTags() {
  const BodyMotion clips[] = {WavingClip(40), WavingClip(30, 1.1)};
  const MotionLibrary library =
      MakeLibrary({"wave", "other"}, clips, MakeBodyProportions(StandingClip(1, 0).poses[0], 0.9));
  const std::vector<std::string> sources = {"mocap/wave.bvh", "mocap/other.glb#1"};
  BridgeTags tags = CollectTags(library, sources, {}, {}, {});
  tags.clips[1].name = "Ärm & <leg> \"2\"";
  for (KeyTag& key : tags.keys) {
    if (key.clip != "wave") key.clip = tags.clips[1].name;
  }
  return tags;
}

std::string SomeText() { return WriteTagsFile(SomeTags()).value(); }

Error Complaint(const std::string& text) {
  const auto tags = ReadTagsFile(text, "tags.xml");
  EXPECT_FALSE(tags);
  return tags ? Error{} : tags.error();
}

TEST(TagsFile, ComesBackToTheLastBit) {
  const BridgeTags tags = SomeTags();
  ASSERT_GT(tags.clips[0].bridge_frames.size(), 3u);
  ASSERT_GT(tags.keys.size(), 1u);
  const auto back = ReadTagsFile(SomeText(), "tags.xml");
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_TRUE(*back == tags);
  EXPECT_EQ(WriteTagsFile(*back).value(), SomeText());
}

TEST(TagsFile, SaysWhereWhatWasFoundAndWhatIsAllowed) {
  const std::string text = SomeText();
  const Error error = Complaint(Replaced(text, "RH=\"mid\"", "RH=\"middle\""));
  EXPECT_EQ(error.place.file, "tags.xml");
  const std::size_t at = text.find("RH=\"mid\"");
  EXPECT_EQ(error.place.line, 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  EXPECT_THAT(error.message, HasSubstr("middle"));
  EXPECT_THAT(error.message, HasSubstr("'down', 'mid', 'up'"));
}

TEST(TagsFile, RefusesHostileInput) {
  const std::string text = SomeText();
  const std::string bomb =
      "<?xml version=\"1.0\"?>\n<!DOCTYPE a [<!ENTITY l \"lol\"><!ENTITY m \"&l;&l;&l;&l;&l;&l;&l;&l;\">"
      "<!ENTITY n \"&m;&m;&m;&m;&m;&m;&m;&m;\">]>\n<bridge-tags>&n;</bridge-tags>";
  EXPECT_THAT(Complaint(bomb).message, HasSubstr("document type declaration"));
  EXPECT_EQ(Complaint(bomb).place.line, 2);
  EXPECT_EQ(Complaint(bomb).place.column, 0) << "not known";
  std::string deep;
  for (int i = 0; i < 100'000; ++i) deep += "<a>";
  const std::string inputs[] = {
      "",
      "no XML at all",
      std::string("\0\1\2", 3),
      "\xff\xfe<\0b\0",
      "<wrong-root/>",
      "<bridge-tags version=\"2\"/>",
      "<bridge-tags version=\"1\"/>",
      "<bridge-tags version=\"1\"><clip/></bridge-tags>",
      deep,
      text.substr(0, text.size() / 2),
      text + "<more/>",
      Replaced(text, "<rules", "<rulers"),
      Replaced(text, "threshold=\"0.4\"", "threshold=\"NaN\""),
      Replaced(text, "threshold=\"0.4\"", "threshold=\"INF\""),
      Replaced(text, "threshold=\"0.4\"", "threshold=\"-1\""),
      Replaced(text, "threshold=\"0.4\"", "threshold=\"0.4\" threshold=\"0.5\""),
      Replaced(text, "frames=\"40\"", "frames=\"99999999999999999999\""),
      Replaced(text, "grades=\"", "grades=\"NaN "),
      Replaced(text, "grades=\"", "grades=\"0 "),
      Replaced(text, "grades=\"0", "grades=\"2"),
      Replaced(text, "min-clips=\"2\"", ""),
      Replaced(text, "<rules", "<rules extra=\"1\""),
      Replaced(text, "version=\"1.0\"", "version=\"1.1\""),  // libxml2 only warns about this edit and the next
      Replaced(text, "<bridge-tags", "<bridge-tags xmlns=\"relative\""),
  };
  for (const std::string& input : inputs) {
    const Error error = Complaint(input);
    EXPECT_EQ(error.place.file, "tags.xml");
    EXPECT_FALSE(error.message.empty());
    EXPECT_THAT(ToString(error), ::testing::Not(HasSubstr("\n")));
  }
}

TEST(TagsFile, IsRefusedBeforeItTakesMinutes) {
  std::string attributes = "\n<bridge-tags";
  for (int i = 0; i < 100'000; ++i) attributes += " a" + std::to_string(i) + "=\"1\"";
  const Error error = Complaint(attributes + "/>");
  EXPECT_THAT(error.message, HasSubstr("bytes without a new XML tag"));
  EXPECT_EQ(error.place.line, 2);
  EXPECT_THAT(Complaint(" \n").message, HasSubstr("is empty"));
  EXPECT_EQ(ToString(Complaint(" \n").place), "tags.xml") << "nothing has no line";
}

TEST(TagsFile, GivesLibxml2sWordsUpTo500Bytes) {
  // The error message contains the value found, so a letter more makes it longer by one.
  const std::string text = SomeText();
  const auto complaint = [&](std::size_t letters) {
    return Complaint(Replaced(text, "RH=\"mid\"", "RH=\"" + std::string(letters, 'x') + "\"")).message;
  };
  const std::size_t others = complaint(100).size() - 100;
  ASSERT_LT(others, 400u);
  const std::string longest = complaint(500 - others);
  EXPECT_EQ(longest.size(), 500u);
  EXPECT_FALSE(longest.ends_with("…"));
  for (std::size_t more : {1u, 100u}) {
    const std::string cut = complaint(500 - others + more);
    EXPECT_EQ(cut.size(), 500 + std::string("…").size());
    EXPECT_TRUE(cut.ends_with("…"));
  }
}

TEST(TagsFile, SaysThatNothingWasSetButTheRulesDefaults) {
  const BridgeTags tags;
  EXPECT_EQ(tags.min_clips, TagRules{}.min_clips);
  EXPECT_EQ(tags.most_per_class, TagRules{}.most_per_class);
  EXPECT_EQ(tags.threshold, InBetweenRules{}.threshold);
}

TEST(TagsFile, MayHoldTheLongestNames) {
  BridgeTags tags = SomeTags();
  for (ClipTags& clip : tags.clips) clip.source = std::string(4096, '"');
  const auto text = WriteTagsFile(tags);
  ASSERT_TRUE(text);
  const auto back = ReadTagsFile(*text, "tags.xml");
  ASSERT_TRUE(back) << ToString(back.error());
  EXPECT_TRUE(*back == tags);
}

TEST(TagsFile, RefusesToWriteNamesThatXmlCannotHold) {
  for (const std::string& name : {std::string("a\nb"), std::string("\xff"), std::string()}) {
    BridgeTags tags = SomeTags();
    tags.clips[0].name = name;
    EXPECT_FALSE(WriteTagsFile(tags));
  }
}

TEST(TagsComparison, FindsWhatHasChanged) {
  const BridgeTags tags = SomeTags();
  EXPECT_THAT(CompareTags(tags, tags).differences, IsEmpty());
  EXPECT_EQ(CompareTags(tags, tags).clips, 2);
  EXPECT_GT(CompareTags(tags, tags).bridge_frames, 3);
  BridgeTags other = tags;
  other.clips[0].bridge_frames[1].grades[0] += 1e-3;
  other.clips[0].bridge_frames.pop_back();
  other.clips[1].name = "renamed";
  other.threshold = 0.5;
  other.weights[2] = 0.25;
  const TagsComparison comparison = CompareTags(tags, other);
  EXPECT_EQ(comparison.clips, 1);
  EXPECT_THAT(comparison.differences, ::testing::SizeIs(::testing::Ge(5)))
      << "weights, grades, a frame, a clip gone and a clip come";
}

/// Returns the tags of a library with feet, by rules that differ from the defaults.
BridgeTags TagsOfMoves() {
  const MotionLibrary library = LibraryOfMoves();
  std::vector<std::string> sources;
  for (const std::string& name : library.names) sources.push_back(name + ".bvh");
  FuzzySystem system;
  system.name = "ours";
  system.memberships.shapes[1] = Gaussian{.mean = 40, .sigma = 20};
  TagRules tag_rules;
  tag_rules.min_clips = 3;
  tag_rules.most_per_class = 5;
  tag_rules.head = {.max_bend = Radians(25), .max_turn_speed = Radians(49.5)};
  return CollectTags(
      library, sources, system, tag_rules,
      {.weights = {0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5}, .threshold = 0.3, .within_class = true});
}

/// Returns the tags' text with rounded numbers, because last digits depend on the compiler.
std::string TextOf(BridgeTags tags) {
  const auto round = [](double& number) { number = std::round(1e6 * number) / 1e6; };
  for (ClipTags& clip : tags.clips) {
    for (TaggedFrame& frame : clip.bridge_frames) {
      round(frame.difference);
      std::ranges::for_each(frame.grades, round);
    }
  }
  return WriteTagsFile(tags).value();
}

TEST(TagsFile, ComplaintsAreAsTheyWere) {
  const std::string text = TextOf(SomeTags());
  const std::vector<std::pair<std::string, std::string>> changes = {
      {"RH=\"mid\"", "RH=\"up\""},
      {"LFK=\"false\"", "LFK=\"true\""},
      {"frames=\"40\"", "frames=\"5\""},
      {"key clip=\"wave\"", "key clip=\"wink\""},
      {"rate-hz=\"30\"", "rate-hz=\"60\""},
      {"rate-hz=\"30\"", "rate-hz=\"30.001\""},
      {"feature=\"RH\"", "feature=\"LH\""},
      {"feature=\"LFK\"", "feature=\"RFK\""},
      {"name=\"wave\"", "name=\"Ärm &amp; &lt;leg&gt; &quot;2&quot;\""},
      {"min-clips=\"2\"", "min-clips=\"2147483648\""},
      {"threshold=\"0.4\"", "threshold=\"+0.4\""},
      {"value=\"1\"", "value=\"1e999\""},
      {"difference=\"0", "difference=\"+0"},
      {"grades=\"0", "grades=\"+0"}};
  std::vector<std::string> complaints;
  for (const auto& [from, to] : changes) complaints.push_back(ToString(Complaint(Replaced(text, from, to))));
  for (const std::string& other : {"\n\n<bridge-tags a=\"" + std::string(65536, 'x') + "\"/>",
                                   std::string("\n<a/><!DOCTYPE x>"), std::string(" \t\r\n")}) {
    complaints.push_back(ToString(Complaint(other)));
  }
  EXPECT_TRUE(testing::AreKept(complaints, "tests/engine/transitions/tags_file/complaints.txt"));
}

bool IsRead(const BridgeTags& tags) { return ReadTagsFile(WriteTagsFile(tags).value(), "tags.xml").has_value(); }

TEST(TagsFile, HoldsFramesAndKeysAgainstTheirClips) {
  BridgeTags tags = SomeTags();
  const int last = tags.clips[0].bridge_frames.back().frame;
  tags.clips[0].frames = last + 1;
  EXPECT_TRUE(IsRead(tags));
  tags.clips[0].frames = last;
  EXPECT_FALSE(IsRead(tags)) << "frames count from 0";
  tags = SomeTags();
  tags.clips[0].bridge_frames[1] = tags.clips[0].bridge_frames[0];
  EXPECT_FALSE(IsRead(tags)) << "they rise";
  tags = SomeTags();
  tags.keys = {{"wave", last}};
  EXPECT_TRUE(IsRead(tags));
  for (int frame = 0; frame < 60; ++frame) {
    tags.keys[0].frame = frame;
    const bool is_bridge_frame = std::ranges::count(tags.clips[0].bridge_frames, frame, &TaggedFrame::frame) == 1;
    EXPECT_EQ(IsRead(tags), is_bridge_frame) << frame;
  }
  for (ClipTags& clip : tags.clips) clip.bridge_frames.clear();
  for (const auto& [frame, is_read] : {std::pair{0, true}, {39, true}, {40, false}}) {
    tags.keys[0].frame = frame;
    EXPECT_EQ(IsRead(tags), is_read) << "without bridge frames, any frame may be a key";
  }
}

TEST(TagsFile, HoldsNamesOfUpTo4096Bytes) {
  BridgeTags tags = SomeTags();
  tags.system = std::string(4096, 'x');
  EXPECT_TRUE(WriteTagsFile(tags));
  tags.system += 'x';
  EXPECT_FALSE(WriteTagsFile(tags));
  tags.system = " ~";
  EXPECT_TRUE(IsRead(tags)) << "a blank is no control character";
  tags.system = "\x1f";
  EXPECT_FALSE(WriteTagsFile(tags));
}

TEST(TagsFile, IsReadWithTagsOfUpTo65536Bytes) {
  const std::string text = SomeText();
  const auto complaint = [&](std::size_t bytes) {
    const std::string tag = "<fuzzy-system";
    return Complaint(Replaced(text, tag, tag + std::string(bytes, ' ')) + "<").message;
  };
  const std::size_t from = text.find("<fuzzy-system"), others = text.find('<', from + 1) - from;
  EXPECT_THAT(complaint(65536 - others), ::testing::Not(HasSubstr("without a new XML tag")));
  EXPECT_THAT(complaint(65537 - others), HasSubstr("found 65537 bytes without a new XML tag; allowed: at most 65536"));
}

TEST(TagsComparison, SaysEveryDifferenceByItsName) {
  const BridgeTags tags = TagsOfMoves();
  ASSERT_GT(tags.clips[1].bridge_frames.size(), 2u);
  BridgeTags other = tags;
  other.system = "theirs";
  other.memberships_digest[0] = 'x';
  other.weights[3] = 0;
  other.standing_hip_height_m += 1e-15;
  other.clips[0].frames += 1;
  other.clips[2].rate_hz = 60;
  other.clips[3].name = "swing";
  auto& frames = other.clips[1].bridge_frames;
  frames[0].frame = 900;
  frames[1].difference += 2e-9;
  frames[2].grades[23] -= 0.9e-9;
  frames[2].difference -= 0.9e-9;
  other.keys.pop_back();
  const TagsComparison comparison = CompareTags(tags, other);
  std::vector<std::string> told = comparison.differences;
  told.push_back(fmt::format("{} clips, {} bridge frames", comparison.clips, comparison.bridge_frames));
  EXPECT_TRUE(testing::AreKept(told, "tests/engine/transitions/tags_file/differences.txt"));
  const auto differs = [&](auto&& change) {
    BridgeTags changed = tags;
    change(changed.clips[1].bridge_frames[1]);
    return CompareTags(tags, changed).differences.size();
  };
  EXPECT_EQ(differs([](TaggedFrame& frame) { ++frame.clips; }), 1u);
  EXPECT_EQ(differs([](TaggedFrame& frame) { frame.tags[4] += 1; }), 1u);
  EXPECT_EQ(differs([](TaggedFrame& frame) { frame.grades[0] += 2e-9; }), 1u);
  EXPECT_EQ(differs([](TaggedFrame& frame) { frame.grades[0] -= 0.9e-9; }), 0u);
}

TEST(MembershipsDigest, TellsFunctionsApartNotNames) {
  FuzzySystem renamed, other;
  renamed.name = "mine";
  other.memberships.shapes[0] = Gaussian{.mean = 20, .sigma = 30};
  EXPECT_EQ(MembershipsDigest(renamed), MembershipsDigest({}));
  EXPECT_NE(MembershipsDigest(other), MembershipsDigest({}));
}

}  // namespace
}  // namespace etude
