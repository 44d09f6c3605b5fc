#include <gtest/gtest.h>

#include <cmath>

#include "engine/transitions/search/frame_matches.h"
#include "engine/transitions/search/grade_index.h"
#include "tests/engine/transitions/search/search_data.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Fingerprint;

void AddTo(Fingerprint& print, const SearchWork& work) { print.Add(work.distances).Add(work.boxes); }

// What a search looks at is part of its answer: a bound that is too weak is still right, but no search any more.
TEST(SearchGolden, OfNeighboursAndTheWorkThatFindsThem) {
  RandomStream dice = SearchDice("golden");
  const std::vector<Grades> frames = WanderingFrames(9000, dice);
  Fingerprint print;
  for (const std::size_t count : {1u, 16u, 17u, 255u, 257u, 4096u, 4097u, 4300u, 9000u}) {
    const GradeIndex index({frames.data(), count}, PaperWeights());
    print.Add(index.Bytes()).Add(index.FrameCount());
    for (const std::size_t asked : {3u, 4500u, 8191u}) {
      SearchWork first, within, nearest;
      for (const double threshold : {0.02, 0.4, 1.3}) {
        const auto found = index.First(frames[asked], threshold, &first);
        print.Add(found.has_value());
        if (found) print.Add(found->frame).Add(found->distance);
        for (const Neighbour& neighbour : index.Within(frames[asked], threshold, &within)) {
          print.Add(neighbour.frame).Add(neighbour.distance);
        }
      }
      for (const int k : {1, 7, 40}) {
        for (const Neighbour& neighbour : index.Nearest(frames[asked], k, &nearest)) {
          print.Add(neighbour.frame).Add(neighbour.distance);
        }
      }
      AddTo(print, first);
      AddTo(print, within);
      AddTo(print, nearest);
    }
  }
  const GradeIndex index(frames, PaperWeights());
  for (std::size_t asked = 4150; asked < frames.size(); asked += 97) {  // beyond the first frames, which are scanned
    SearchWork work;
    for (const double threshold : {0.01, 0.05, 0.1}) print.Add(index.First(frames[asked], threshold, &work)->frame);
    AddTo(print, work);
  }
  EXPECT_TRUE(print.Is(3943, 1052527.93856));
}

TEST(SearchGolden, OfMatchesAndTheWorkThatFindsThem) {
  RandomStream dice = SearchDice("matches");
  std::vector<std::vector<Grades>> clips;
  std::vector<std::vector<Tags>> tags;
  for (const int count : {300, 17, 65, 530}) {
    clips.push_back(WanderingFrames(count, dice));
    tags.emplace_back();
    for (const Grades& grades : clips.back()) tags.back().push_back(ChooseTags(grades));
  }
  std::vector<int> every_fifth;
  for (int f = 2; f < 300; f += 5) every_fifth.push_back(f);
  std::vector<MatchClip> asked;
  for (std::size_t c = 0; c < clips.size(); ++c) asked.push_back({.grades = clips[c], .tags = tags[c]});
  asked[0].frames = every_fifth;
  Fingerprint print;
  std::vector<std::size_t> told;
  for (const double threshold : {0.1, 0.4, 1.2}) {
    for (const bool within_class : {false, true}) {
      SearchWork work{.distances = 5, .boxes = 7};
      const MatchTable table = FindMatches(asked, {.threshold = threshold, .within_class = within_class}, &work,
                                           [&](std::size_t done, std::size_t all) {
                                             told.insert(told.end(), {done, all});
                                           });
      AddTo(print, work);
      for (int from = 0; from < table.ClipCount(); ++from) {
        print.Add(table.AskedFrames(from));
        for (int to = 0; to < table.ClipCount(); ++to) {
          print.Add(table.Share(from, to));
          for (const FrameMatches& match : table.Of(from, to)) {
            print.Add(match.frame).Add(match.first).Add(match.nearest).Add(match.distance);
          }
        }
      }
    }
  }
  EXPECT_TRUE(print.Add(told).Is(681, -19283.1723609));
}

TEST(SearchGolden, OfBoxesAndBlocks) {
  RandomStream dice = SearchDice("boxes");
  const GradeMetric metric({0.25, 1.5, 0.5, 1, 2, 0.75, 0.3, 0.7, 0.5, 0.5});
  Fingerprint print;
  for (const int count : {1, 16, 40, 300}) {
    const TimeBlocks blocks(RandomFrames(count, -0.2, 1, dice));
    const Grades query = RandomFrames(1, 0, 1, dice)[0];
    print.Add(blocks.frame_count).Add(blocks.BlockCount()).Add(blocks.boxes.size());
    for (const BoxBlock& block : blocks.boxes) {
      print.Add(block.low).Add(block.high);
      const BlockResult bounds = SquaredBounds(metric, {query, query}, block, kInfinity);
      print.Add(bounds.squared).Add(bounds.kept).Add(bounds.least);
    }
    for (const FrameBlock& block : blocks.frames) {
      const BlockResult near = SquaredDistances(metric, query, block, 1.1);
      print.Add(near.kept).Add(near.least);
    }
  }
  for (const double distance : {0.0, 1e-200, 0.4, 7.0, 1e200}) print.Add(std::isfinite(SquaredLimit(distance)));
  print.Add(metric.first_term).Add(metric.weights);
  for (const int count : {0, 1, 7, 15, 16, 17}) print.Add(LanesOf(count)).Add(BlocksFor(count));
  EXPECT_TRUE(print.Is(4285, 103473.317358));
}

}  // namespace
}  // namespace etude
