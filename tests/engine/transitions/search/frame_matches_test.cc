#include "engine/transitions/search/frame_matches.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/engine/transitions/search/search_data.h"

namespace etude {
namespace {

/// Clips with what may be asked about them.
struct Library {
  std::vector<std::vector<Grades>> grades;
  std::vector<std::vector<Tags>> tags;
  std::vector<std::vector<int>> frames;

  void Add(std::vector<Grades> clip, int every) {
    frames.emplace_back();
    for (int f = 0; f < static_cast<int>(clip.size()); f += every) frames.back().push_back(f);
    tags.emplace_back();
    for (const Grades& frame : clip) tags.back().push_back(ChooseTags(frame));
    grades.push_back(std::move(clip));
  }
  /// Either all frames take part, or `frames`.
  std::vector<MatchClip> Clips(bool all) const {
    std::vector<MatchClip> clips;
    for (std::size_t c = 0; c < grades.size(); ++c) {
      clips.push_back({.grades = grades[c], .frames = std::nullopt, .tags = tags[c]});
      if (!all) clips.back().frames = frames[c];
    }
    return clips;
  }
};

/// The second implementation: every frame with every frame.
std::vector<FrameMatches> LoopOverAll(const MatchClip& from, const MatchClip& to, const MatchRules& rules) {
  const auto frames_of = [](const MatchClip& clip) {
    std::vector<int> frames;
    for (int f = 0; f < static_cast<int>(clip.grades.size()); ++f) {
      if (!clip.frames || std::ranges::binary_search(*clip.frames, f)) frames.push_back(f);
    }
    return frames;
  };
  std::vector<FrameMatches> found;
  for (int a : frames_of(from)) {
    std::optional<FrameMatches> matches;
    for (int b : frames_of(to)) {
      if (b + 1 == static_cast<int>(to.grades.size())) continue;
      if (rules.within_class && from.tags[a] != to.tags[b]) continue;
      const double distance = ComputeDistance(from.grades[a], to.grades[b], rules.weights).value;
      if (!(distance < rules.threshold)) continue;
      if (!matches) matches = {a, b, b, distance};
      if (distance < matches->distance) matches = {a, matches->first, b, distance};
    }
    if (matches) found.push_back(*matches);
  }
  return found;
}

/// Compares every pair of clips; returns how many frames had matches.
std::size_t ExpectSameMatches(std::span<const MatchClip> clips, const MatchRules& rules) {
  const MatchTable table = FindMatches(clips, rules);
  EXPECT_EQ(table.ClipCount(), static_cast<int>(clips.size()));
  std::size_t compared = 0;
  for (int a = 0; a < table.ClipCount(); ++a) {
    for (int b = 0; b < table.ClipCount(); ++b) {
      SCOPED_TRACE(std::to_string(a) + " to " + std::to_string(b));
      const auto found = table.Of(a, b);
      const auto expected = a == b ? std::vector<FrameMatches>{} : LoopOverAll(clips[a], clips[b], rules);
      EXPECT_EQ(found.size(), expected.size());
      for (std::size_t i = 0; i < std::min(found.size(), expected.size()); ++i) {
        EXPECT_EQ(found[i].frame, expected[i].frame);
        EXPECT_EQ(found[i].first, expected[i].first);
        EXPECT_EQ(found[i].nearest, expected[i].nearest);
        EXPECT_EQ(found[i].distance, expected[i].distance) << "to the last bit";
      }
      const double asked = table.QueryFrames(a);
      EXPECT_EQ(table.Share(a, b), asked == 0 ? 0 : static_cast<double>(expected.size()) / asked);
      compared += expected.size();
    }
  }
  return compared;
}

Library UnevenLibrary() {
  RandomStream dice = SearchDice("partners");
  Library library;
  int every = 1;
  for (int count : {200, 1, 2, 47, 0, 90, 260}) library.Add(WanderingFrames(count, dice), every++);
  // A clip that passes through another one's frames again, so that equal distances occur, far apart in time.
  std::vector<Grades> again = library.grades[0];
  again.insert(again.end(), library.grades[0].rbegin(), library.grades[0].rend());
  library.Add(std::move(again), 3);
  return library;
}

TEST(FindMatches, AnswersAsALoopDoesForClipsOfAnyLength) {
  const Library library = UnevenLibrary();
  for (double threshold : {kPaperThreshold, 1.5}) {
    for (bool all : {true, false}) {
      for (bool within_class : {false, true}) {
        SCOPED_TRACE(::testing::Message()
                     << threshold << (all ? " all" : " some") << (within_class ? " in class" : ""));
        const MatchRules rules{.threshold = threshold, .within_class = within_class};
        EXPECT_GT(ExpectSameMatches(library.Clips(all), rules), 100u);
      }
    }
  }
}

TEST(FindMatches, AnswersAsALoopDoesForAnyThresholdAndWeights) {
  const Library library = UnevenLibrary();
  FeatureWeights two_features{};
  two_features[0] = two_features[7] = 4;
  for (double threshold : {1e-160, 0.02, 1e9, std::numeric_limits<double>::infinity()}) {
    SCOPED_TRACE(threshold);
    ExpectSameMatches(library.Clips(false), {.threshold = threshold});
    EXPECT_GT(ExpectSameMatches(library.Clips(false), {.weights = two_features, .threshold = threshold}), 10u);
  }
}

TEST(FindMatches, HasNoneBelowAThresholdThatIsNone) {
  const Library library = UnevenLibrary();
  for (double threshold : {0.0, -1.0}) {
    EXPECT_EQ(ExpectSameMatches(library.Clips(true), {.threshold = threshold}), 0u);
  }
}

TEST(FindMatches, OfALibraryOfOneClipOrNoneIsEmpty) {
  RandomStream dice = SearchDice("one");
  Library library;
  EXPECT_EQ(FindMatches(library.Clips(true)).ClipCount(), 0);
  library.Add(WanderingFrames(100, dice), 1);
  EXPECT_EQ(ExpectSameMatches(library.Clips(true), {}), 0u);
}

TEST(FindMatches, ComparesFewOfAllPairs) {
  RandomStream dice = SearchDice("few");
  Library library;
  for (int i = 0; i < 6; ++i) library.Add(WanderingFrames(400, dice), 1);
  SearchWork work;
  FindMatches(library.Clips(true), {}, &work);
  EXPECT_GT(work.boxes, 0);
  EXPECT_LT(work.distances, 6 * 5 * 400 * 400 / 10);
  SearchWork everything;
  FindMatches(library.Clips(true), {.threshold = 1e9}, &everything);
  EXPECT_GT(everything.distances, work.distances) << "the control";
}

}  // namespace
}  // namespace etude
