#include "engine/recognition/whole_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "engine/recognition/pose_vector.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "tests/engine/recognition/waving_body.h"

namespace etude {
namespace {

/// Returns moves by `people` people of different size and tempo: the left arm up, both arms up, the left arm half-way.
std::vector<TaughtMove> ArmMoves(int people) {
  std::vector<TaughtMove> moves(3);
  const char* const names[] = {"left", "both", "low"};
  for (int m = 0; m < 3; ++m) {
    moves[m].name = names[m];
    moves[m].span_s = 4;
    for (int p = 0; p < people; ++p) {
      const double high = (m == 2 ? 1.3 : 2.5) + 0.1 * p;
      moves[m].examples.push_back(StreamOf(Swing(high, m == 1 ? high : 0, 2 + 0.2 * p, 1 - 0.1 * p)));
    }
  }
  return moves;
}

std::unique_ptr<Recogniser> MadeRecogniser(const char* name, const std::vector<TaughtMove>& taught) {
  return *MakeRecogniser({.kind = FindRecogniser(name)}, taught);
}

/// The first move is requested from the first frame on.
EvidenceTrace TraceOf(const char* name, const std::vector<TaughtMove>& taught, const SkeletonStream& stream) {
  const auto recogniser = MadeRecogniser(name, taught);
  const int frames = static_cast<int>(stream.frames.size());
  return *FollowStream(*recogniser, taught.size(), SeeStream(stream, {}), {{AskedMove{0, {0, frames}}}});
}

std::optional<std::size_t> WholeOfStream(const char* name, const std::vector<TaughtMove>& taught,
                                         const BodyMotion& performed) {
  const auto recogniser = MadeRecogniser(name, taught);
  const auto follower = recogniser->Follow(30);
  const SeenStream seen = SeeStream(StreamOf(performed), {});
  for (std::size_t t = 0; t < seen.frames.size(); ++t) follower->Update(seen[t]);
  return follower->Whole();
}

TEST(WholeBody, NamesAPerformanceOfWhichBeginningAndEndAreTold) {
  const auto taught = ArmMoves(3);
  EXPECT_EQ(WholeOfStream("whole-body", taught, Swing(2.4, 0, 2.7, 0.6)), 0u);
  EXPECT_EQ(WholeOfStream("whole-body", taught, Swing(2.4, 2.4, 1.5, 1.1)), 1u);
  EXPECT_EQ(WholeOfStream("whole-body", taught, Swing(1.2, 0, 2.2)), 2u);
  EXPECT_EQ(WholeOfStream("dtw", taught, Swing(2.4, 0, 2.7)), std::nullopt) << "knows passages only";
  const auto recogniser = MadeRecogniser("whole-body", taught);
  EXPECT_EQ(recogniser->Follow(30)->Whole(), std::nullopt) << "nothing was seen";
}

TEST(WholeBody, OneOddExampleDoesNotNameAMove) {
  auto taught = ArmMoves(3);
  taught[1].examples.push_back(StreamOf(Swing(2.45, 0, 2)));  // the left arm, wrongly labelled as both arms
  EXPECT_EQ(WholeOfStream("whole-body", taught, Swing(2.45, 0, 2)), 0u);
}

TEST(WholeBody, TheWrongSideTakesAwayWhatTheJudgeGives) {
  const auto taught = ArmMoves(3);
  const auto asked = [&](const char* name, const BodyMotion& performed) {
    return TraceOf(name, taught, Then({performed, Rest(1)})).asked.back();
  };
  const BodyMotion right = Swing(2.55, 0, 2.1), wrong_side = Swing(0, 2.55, 2.1);
  EXPECT_EQ(asked("whole-body", right), asked("learnt", right));
  EXPECT_GT(asked("learnt", right), 0);
  EXPECT_LT(asked("whole-body", wrong_side), 0.3 * asked("learnt", wrong_side));
}

TEST(WholeBody, AMoveThatIsItsOwnImageHasNoSides) {
  auto taught = ArmMoves(3);
  std::swap(taught[0], taught[1]);  // requests both arms
  for (const BodyMotion& performed : {Swing(2.5, 2.3, 2), Swing(2.3, 2.5, 2), Swing(0, 2.5, 2)}) {
    const SkeletonStream stream = Then({performed, Rest(1)});
    EXPECT_EQ(TraceOf("whole-body", taught, stream).asked, TraceOf("learnt", taught, stream).asked);
  }
}

TEST(WholeBody, SpotsByDistanceWhereThreePeopleTaughtAndAsTheJudgeElse) {
  const SkeletonStream stream = Then({Rest(2), Swing(2.55, 0, 2.1), Rest(2), Swing(2.55, 2.55, 2.1), Rest(2)});
  EXPECT_EQ(TraceOf("whole-body", ArmMoves(2), stream).spotted, TraceOf("learnt", ArmMoves(2), stream).spotted);
  const auto found = FindMoves(TraceOf("whole-body", ArmMoves(3), stream), 30, {.threshold = 0.7, .refractory_s = 2});
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].move, 0u);
  EXPECT_EQ(found[1].move, 1u);
  EXPECT_TRUE(found[0].frame > 80 && found[0].frame < 150) << found[0].frame;
  EXPECT_TRUE(found[1].frame > 200 && found[1].frame < 270) << found[1].frame;
}

/// Returns the cost of symmetric dynamic time warping by recursion.
double WarpedWhole(const std::vector<double>& gaps, std::size_t i, std::size_t j, std::size_t columns) {
  const double gap = gaps[i * columns + j];
  if (i == 0 && j == 0) return 2 * gap;
  double best = std::numeric_limits<double>::infinity();
  if (i > 0 && j > 0) best = std::min(best, WarpedWhole(gaps, i - 1, j - 1, columns) + 2 * gap);
  if (i > 0) best = std::min(best, WarpedWhole(gaps, i - 1, j, columns) + gap);
  if (j > 0) best = std::min(best, WarpedWhole(gaps, i, j - 1, columns) + gap);
  return best;
}

TEST(WholeBody, NamesTheMoveThatWarpingBySearchOfAllWaysFindsNearest) {
  // Five steps each, so that all paths can be tried.
  const BodyMotion seen = Swing(1.9, 0.7, 1.0 / 3);
  std::vector<TaughtMove> taught;
  std::vector<double> costs;
  for (int m = 0; m < 8; ++m) {
    const SkeletonStream example = StreamOf(Swing(1.2 + 0.2 * m, 1.4 - 0.2 * m, 1.0 / 3));
    taught.push_back({.name = std::string(1, static_cast<char>('a' + m)), .span_s = 1, .examples = {example}});
    std::vector<double> gaps;
    const auto steps = [](const SkeletonStream& stream, PoseParts parts) { return DescribeStream(stream, parts); };
    const auto a = steps(StreamOf(seen), PoseParts::kJoints), b = steps(example, PoseParts::kJoints);
    const auto c = steps(StreamOf(seen), PoseParts::kLimbs), d = steps(example, PoseParts::kLimbs);
    for (std::size_t i = 0; i < a.size(); ++i) {
      for (std::size_t j = 0; j < b.size(); ++j) {
        gaps.push_back(SquaredDistance(a[i], b[j]) / (0.08 * 0.08) + SquaredDistance(c[i], d[j]) / (0.15 * 0.15));
      }
    }
    ASSERT_EQ(a.size(), 5u);
    costs.push_back(WarpedWhole(gaps, a.size() - 1, b.size() - 1, b.size()));
  }
  const auto nearest = static_cast<std::size_t>(std::ranges::min_element(costs) - costs.begin());
  EXPECT_EQ(WholeOfStream("whole-body", taught, seen), nearest);
}

}  // namespace
}  // namespace etude
