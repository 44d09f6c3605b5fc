#include "bench/tasks/search/run.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace etude {
namespace {

/// A library of frames with one grade that counts: their distances from `At(0)` are what is given.
Grades At(double place) {
  Grades grades{};
  grades[0] = place;
  return grades;
}

SearchLibrary LibraryAt(const std::vector<double>& places) {
  std::vector<Grades> frames;
  for (const double place : places) frames.push_back(At(place));
  GradeIndex index(frames, PaperWeights());
  return {frames, frames, std::move(index), ""};
}

const std::vector<SearchQuestion> kAll = {SearchQuestion::kFirst, SearchQuestion::kWithin, SearchQuestion::kNearest,
                                          SearchQuestion::kNearest10};

// Closed form: the answers can be read off.
TEST(FindPlainly, AnswersEveryQuestionAsItsNameSays) {
  const SearchLibrary library = LibraryAt({0.9, 0.3, 0.1, 0.4, 0.1, 0.5});
  const SearchProblem problem{library, PaperWeights(), 0.4};
  const auto found = FindPlainly(problem, std::vector{At(0)}, {kAll.begin(), kAll.end()});
  EXPECT_EQ(found.at(SearchQuestion::kFirst)[0], FoundFrames({1}));
  EXPECT_EQ(found.at(SearchQuestion::kWithin)[0], FoundFrames({1, 2, 4})) << "0.4 itself is not below it";
  EXPECT_EQ(found.at(SearchQuestion::kNearest)[0], FoundFrames({2})) << "the earlier of equal ones";
  EXPECT_EQ(found.at(SearchQuestion::kNearest10)[0], FoundFrames({2, 4, 1, 3, 5, 0}))
      << "all, there being fewer than ten";
}

TEST(FindPlainly, FindsNothingWhereNothingMatches) {
  const SearchLibrary library = LibraryAt({0.9, 0.8});
  const auto found = FindPlainly({library, PaperWeights(), 0.1}, std::vector{At(0)}, {kAll.begin(), kAll.end()});
  EXPECT_TRUE(found.at(SearchQuestion::kFirst)[0].empty());
  EXPECT_TRUE(found.at(SearchQuestion::kWithin)[0].empty());
  EXPECT_EQ(found.at(SearchQuestion::kNearest)[0], FoundFrames({1}));
}

// Many frames at the same few places, among them the threshold itself: what rounding or ties would spoil.
TEST(Find, IndexAndBruteForceAnswerAsThePlainLoopDoes) {
  RandomStream dice({1, "find", 0}, "places");
  std::vector<double> places;
  for (int i = 0; i < 400; ++i) places.push_back(0.05 * static_cast<double>(dice.IndexBelow(20)));
  const SearchLibrary library = LibraryAt(places);
  const SearchProblem problem{library, PaperWeights(), 0.4};
  std::vector<Grades> queries;
  for (int i = 0; i < 20; ++i) queries.push_back(At(0.05 * i));
  const auto truth = FindPlainly(problem, queries, {kAll.begin(), kAll.end()});
  for (const SearchQuestion question : kAll) {
    EXPECT_EQ(FindByIndex(problem, queries, question).found, truth.at(question)) << QuestionName(question);
    const SearchAnswer loop = FindByBruteForce(problem, queries, question);
    EXPECT_EQ(loop.found, truth.at(question)) << QuestionName(question);
    EXPECT_FALSE(loop.boxes);
    if (question == SearchQuestion::kFirst) continue;
    EXPECT_TRUE(std::ranges::all_of(*loop.distances, [](std::int64_t seen) { return seen == 400; }));
  }
}

TEST(MakeSearchLibrary, ASmallerOneIsTheBeginningOfALargerOneAndHeldOutFramesAreNotInIt) {
  const ClipLibrary clips = *LoadClips({"builtin:clap", "builtin:sway"}, {});
  const SearchLibrary small = MakeSearchLibrary(clips, {}, 500), large = MakeSearchLibrary(clips, {}, 2000);
  ASSERT_EQ(small.frames.size(), 500u);
  ASSERT_EQ(large.frames.size(), 2000u);
  EXPECT_TRUE(std::equal(small.frames.begin(), small.frames.end(), large.frames.begin()));
  EXPECT_NE(small.digest, large.digest);
  for (const Grades& query : DrawQueries(large, 50, {1, "test", 0})) {
    EXPECT_EQ(std::count(large.frames.begin(), large.frames.end(), query), 0);
  }
}

}  // namespace
}  // namespace etude
