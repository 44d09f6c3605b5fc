// The golden value of the recognition pipeline: a noisy sensor that loses joints and bodies, and the evidence of every
// recogniser. The other tests of this folder check that results are right.
#include <gtest/gtest.h>

#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"
#include "tests/engine/recognition/waving_body.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;

// Returns the motions in sequence as a sensor with errors of `noise` metres reports them; it guesses some joints, and
// loses others and sometimes the whole body.
SkeletonStream Noisy(const std::vector<BodyMotion>& motions, std::uint64_t seed, double noise, double rate_hz = 30) {
  SkeletonStream stream = Then(motions);
  stream.rate_hz = rate_hz;
  Dice dice(seed);
  for (SensedFrame& frame : stream.frames) {
    for (SensedJoint& joint : frame.joints) {
      joint.position += noise * dice.Vector();
      const auto draw = dice.Below(20);
      joint.state = draw == 0   ? TrackingState::kNotTracked
                    : draw <= 2 ? TrackingState::kInferred
                                : TrackingState::kTracked;
    }
    if (dice.Below(25) == 0) frame = {};
  }
  return stream;
}

SkeletonStream NoisyDance(std::uint64_t seed, double rate_hz = 30) {
  const FloorMove elsewhere{.yaw = 0.4, .x = 1, .z = 2};
  return Noisy({Rest(0.7, 0.9, elsewhere), Swing(2.5, 0.1, 1.9, 0.9, elsewhere), Rest(0.5, 0.9, elsewhere),
                Swing(1.5, 1.4, 2.2, 0.9, elsewhere), Swing(0.1, 2.4, 1.6, 0.9, elsewhere)},
               seed, 0.02, rate_hz);
}

// Returns three moves; the first two have `people` examples.
std::vector<TaughtMove> NoisyMoves(int people) {
  std::vector<TaughtMove> moves = {
      {.name = "left", .poses = {{{{Feature::kLH, 60, 25}, {Feature::kRH, 0, 30}}}, {{{Feature::kLH, 140, 30}}}}},
      {.name = "both",
       .poses =
           {{{{Feature::kRH, 80, 25}, {Feature::kLH, 85, 22}, {Feature::kPosture, 80, 9}, {Feature::kLHE, 0, 40}}}}},
      {.name = "right", .poses = {{{{Feature::kRH, 100, 60}}}, {{{Feature::kRH, 30, 40}}}, {{{Feature::kLH, 5, 30}}}}}};
  for (std::size_t move = 0; move < moves.size(); ++move) {
    moves[move].span_s = 2.5 + 0.3 * static_cast<double>(move);
    for (int p = 0; p < (move == 2 ? std::min(people, 2) + people / 3 : people); ++p) {
      const double high = 2.4 + 0.1 * p, low = 0.1 * p;
      moves[move].examples.push_back(
          Noisy({Swing(move == 2 ? low : (move == 1 ? 1.5 : high), move == 0 ? low : (move == 1 ? 1.5 : high),
                       1.7 + 0.25 * p, 1 - 0.08 * p)},
                10 * move + static_cast<std::size_t>(p), 0.01));
    }
  }
  return moves;
}

void AddTrace(const EvidenceTrace& trace, Fingerprint& print) {
  print.Add(trace.moves).Add(trace.asked).Add(trace.spotted);
}

TEST(Recognition, GoldenEvidenceOfEveryRecogniser) {
  Fingerprint print;
  for (const RecogniserKind& kind : AllRecognisers()) {
    for (int setup = 0; setup < 3; ++setup) {
      RecogniserOptions options{.kind = &kind};
      if (setup > 0) options.weights = {.weighting = Weighting::kAdaptive, .inferred_weight = 0.4};
      for (const NumberSetting& setting : kind.settings) {
        options.settings.push_back(setting.is_whole ? 1.0 + setup : setting.fallback * (1 - 0.2 * setup));
      }
      // Three people teach all moves, one person does, or one person teaches one move.
      std::vector<TaughtMove> taught = NoisyMoves(setup == 0 ? 3 : 1);
      if (setup == 2) taught.resize(1);
      const auto recogniser = *MakeRecogniser(options, taught);
      const SeenStream seen = SeeStream(NoisyDance(5, setup == 1 ? 13 : 30), {});
      std::vector<AskedMove> asked = {{0, {11, 90}}, {taught.size() - 1, {90, 150}}, {0, {150, 170}}};
      AddTrace(*FollowStream(*recogniser, taught.size(), seen, asked), print);
      const auto follower = recogniser->Follow(30);
      for (std::size_t t = 0; t < 70; ++t) follower->Update(seen[t]);
      print.Add(follower->Whole());
    }
  }
  EXPECT_TRUE(print.Is(14577, -1914.09078745));
}

}  // namespace
}  // namespace etude
