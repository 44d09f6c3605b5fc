#include "engine/base/gaps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace etude {
namespace {

using Track = std::vector<std::optional<double>>;

/// Fills the gaps of a track by straight lines.
int Bridge(Track& track, std::size_t max_gap) {
  return FillGaps(
      track.size(), max_gap, [&](std::size_t frame) { return track[frame].has_value(); },
      [&](std::size_t from, std::size_t at, std::size_t to, double share) {
        track[at] = std::lerp(*track[from], *track[to], share);
      });
}

TEST(Gaps, AreFilledUpToALength) {
  const Track gappy = {std::nullopt, 1, std::nullopt, 3, std::nullopt, std::nullopt, 6, std::nullopt};
  Track one = gappy, two = gappy;
  EXPECT_EQ(Bridge(one, 1), 1);
  EXPECT_EQ(one, (Track{std::nullopt, 1, 2, 3, std::nullopt, std::nullopt, 6, std::nullopt}));
  EXPECT_EQ(Bridge(two, 2), 3);
  EXPECT_EQ(two, (Track{std::nullopt, 1, 2, 3, 4, 5, 6, std::nullopt})) << "the ends are no gaps";
}

TEST(Gaps, AreNotMadeWhereNothingIsKnown) {
  Track none(3), empty;
  EXPECT_EQ(Bridge(none, 10), 0);
  EXPECT_EQ(none, Track(3));
  EXPECT_EQ(Bridge(empty, 10), 0);
}

}  // namespace
}  // namespace etude
