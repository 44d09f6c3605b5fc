// Golden values of whole results: a noisy sensor that loses joints and bodies, and all that is read off its stream.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/recognition/alignment.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/key_pose.h"
#include "engine/recognition/learnt_model.h"
#include "engine/recognition/measuring_recogniser.h"
#include "engine/recognition/performance_measures.h"
#include "engine/recognition/pose_vector.h"
#include "engine/recognition/recognise.h"
#include "engine/recognition/recognisers.h"
#include "engine/recognition/sight.h"
#include "tests/engine/recognition/waving_body.h"
#include "tests/support/fingerprint.h"

namespace etude {
namespace {

using testing::Dice;
using testing::Fingerprint;
using Kept = std::pair<std::size_t, double>;

// The motions one after the other as a sensor off by `noise` metres tells them, which guesses some joints, loses
// others and now and then the whole body.
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

// Three moves, of which the first two have so many examples.
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
  const std::map<std::string, std::array<Kept, 3>> kept = {
      {"key-pose", {{{832, 56.8777950396}, {832, 61.9230302917}, {418, 16.3649004799}}}},
      {"fuzzy-rules", {{{832, 55.2392731334}, {832, 61.176406541}, {418, 18.0714580149}}}},
      {"dtw", {{{832, 64.8079410939}, {832, 59.2214381592}, {418, 15.3094766599}}}},
      {"nearest", {{{832, 61.1739721399}, {832, 62.9852568628}, {418, 17.222279136}}}},
      {"learnt", {{{832, 63.6728978528}, {832, 66.7490273552}, {418, 13.8715519881}}}},
      {"coached", {{{832, 63.3871431607}, {832, 65.6888038338}, {418, 13.5541584914}}}},
      {"whole-body", {{{833, 65.4273509344}, {833, 65.6717585801}, {419, 13.1741301774}}}},
  };
  for (const RecogniserKind& kind : AllRecognisers()) {
    ASSERT_TRUE(kept.contains(kind.name));
    for (int setup = 0; setup < 3; ++setup) {
      RecogniserOptions options{.kind = &kind};
      if (setup > 0) options.weights = {.weighting = Weighting::kAdaptive, .inferred_weight = 0.4};
      for (const NumberSetting& setting : kind.settings) {
        options.settings.push_back(setting.is_whole ? 1.0 + setup : setting.fallback * (1 - 0.2 * setup));
      }
      // Three people teach all moves, or one, or one a single move.
      std::vector<TaughtMove> taught = NoisyMoves(setup == 0 ? 3 : 1);
      if (setup == 2) taught.resize(1);
      const auto recogniser = *MakeRecogniser(options, taught);
      const SeenStream seen = SeeStream(NoisyDance(5, setup == 1 ? 13 : 30), {});
      std::vector<AskedMove> asked = {{0, {11, 90}}, {taught.size() - 1, {90, 150}}, {0, {150, 170}}};
      Fingerprint print;
      AddTrace(*FollowStream(*recogniser, taught.size(), seen, asked), print);
      const auto follower = recogniser->Follow(30);
      for (std::size_t t = 0; t < 70; ++t) follower->Update(seen[t]);
      print.Add(follower->Whole());
      const Kept& golden = kept.at(kind.name)[static_cast<std::size_t>(setup)];
      EXPECT_TRUE(print.Is(golden.first, golden.second)) << kind.name << ", " << setup;
    }
  }
}

TEST(Recognition, GoldenSettings) {
  Fingerprint print;
  for (const RecogniserKind& kind : AllRecognisers()) {
    print.Add(kind.threshold).Add(kind.needs_key_poses).Add(kind.needs_examples);
    for (const NumberSetting& setting : kind.settings) {
      print.Add(setting.fallback).Add(setting.lowest).Add(setting.largest).Add(setting.is_whole);
    }
  }
  EXPECT_TRUE(print.Is(41, -73.093872209));
}

TEST(Recognition, GoldenMeasures) {
  const std::array<Kept, 2> kept = {{{38466, -966.015778246}, {36687, -488.205067156}}};
  for (const std::size_t moves : {3, 1}) {
    std::vector<TaughtMove> taught = NoisyMoves(2);
    taught.resize(moves);
    Fingerprint print;
    const auto recogniser =
        MakeMeasuringRecogniser(taught, {.weighting = Weighting::kAdaptive},
                                [&](Occasion occasion, std::size_t move, const PerformanceMeasures& measures) {
                                  print.Add(occasion).Add(move).Add(measures);
                                  return 1 / (1 + measures[kDistanceMeasure]);
                                });
    const SeenStream seen = SeeStream(NoisyDance(6), {});
    const std::vector<AskedMove> asked = {{0, {15, 85}}, {moves - 1, {95, 170}}, {0, {170, 205}}};
    AddTrace(*FollowStream(*recogniser, moves, seen, asked), print);
    const Kept& golden = kept[moves == 3 ? 0 : 1];
    EXPECT_TRUE(print.Is(golden.first, golden.second)) << moves;
  }
}

PoseVector RandomPoseVector(Dice& dice) {
  PoseVector pose;
  for (glm::dvec3& part : pose.parts) part = 0.5 * dice.Vector();
  for (double& weight : pose.weights) weight = dice.Below(5) == 0 ? 0 : 0.5 + 0.5 * dice.Signed();
  return pose;
}

// A pattern that drifts, and what is seen of it: late, quicker than taught, and not quite the same.
struct DriftingPattern {
  std::vector<PoseVector> pattern, seen;
  DriftingPattern(std::uint64_t seed, int size, double pace, int late) {
    Dice dice(seed);
    const PoseVector a = RandomPoseVector(dice), b = RandomPoseVector(dice);
    const auto at = [&](double t) {
      PoseVector pose = a;
      for (std::size_t i = 0; i < kPosePartCount; ++i) {
        pose.parts[i] = std::cos(0.23 * t) * a.parts[i] + std::sin(0.17 * t + 0.3) * b.parts[i] + 0.02 * dice.Vector();
      }
      return pose;
    };
    for (int t = 0; t < size; ++t) pattern.push_back(at(t));
    for (int t = 0; t < size + 9; ++t) seen.push_back(at(pace * (t - late)));
  }
};

TEST(Recognition, GoldenComparisonsByTheClock) {
  Fingerprint clock_print, rigid_print, path_print;
  PersonBaseline person;
  for (int trial = 0; trial < 12; ++trial) {
    const DriftingPattern made(trial, 7 + 5 * trial, 1 + 0.1 * (trial % 5 - 2), trial % 4);
    ClockComparison clock(made.pattern);
    RigidComparison rigid(made.pattern);
    SubsequenceAligner aligner(made.pattern, 4 + 3 * trial);
    for (std::size_t t = 0; t < made.seen.size(); ++t) {
      clock.Update(made.seen[t]);
      rigid.Update(made.seen[t]);
      aligner.Update(made.seen[t]);
      const std::vector<StepPair> path = aligner.Path();
      if (std::isfinite(aligner.Cost())) path_print.Add(aligner.Cost());
      for (const StepPair& pair : path) path_print.Add(pair.seen).Add(pair.taught);
      if (t % 5 != 4 && t + 1 < made.seen.size()) continue;
      for (const double usual_s : {-0.1, 0.0, 0.31, 2.0}) {
        clock_print.Add(clock.Measure(usual_s).All());
        rigid_print.Add(rigid.Measure(usual_s));
      }
      if (path.empty()) continue;
      PerformanceMeasures measures = Measure({.path = path,
                                              .seen = [&](int n) -> const PoseVector& { return made.seen[n]; },
                                              .pattern = made.pattern,
                                              .cost = aligner.Cost(),
                                              .other_cost = trial % 3 == 0 ? INFINITY : 0.1});
      std::ranges::copy(clock.Measure(0).All(), measures.begin() + kClockSlice.first);
      std::ranges::copy(rigid.Measure(0), measures.begin() + kRigidSlice.first);
      person.Relate(measures);
      person.Add(measures);
      path_print.Add(measures).Add(person.Shift());
    }
    if (trial == 6) aligner.Reset();
    path_print.Add(aligner.Path().size());
  }
  EXPECT_TRUE(clock_print.Is(4104, -77.9379970286));
  EXPECT_TRUE(rigid_print.Is(19152, 626.281971991));
  EXPECT_TRUE(path_print.Is(10363, -145.234721801));
}

void AddPose(const PoseVector& pose, Fingerprint& print) {
  for (const glm::dvec3& part : pose.parts) print.Add(part);
  print.Add(pose.weights);
}

TEST(Recognition, GoldenPoseVectors) {
  Fingerprint print;
  for (const PoseParts parts : {PoseParts::kJoints, PoseParts::kLimbs}) {
    for (const double rate_hz : {30.0, 7.0, 40.0}) {
      const SkeletonStream stream = NoisyDance(3, rate_hz);
      StepDescriber describer(parts, {.weighting = Weighting::kAdaptive}, rate_hz);
      LiveSight sight({}, rate_hz);
      for (std::size_t t = 0; t < 80; ++t) {
        print.Add(describer.Update(sight.Update(stream.frames[t]))).Add(describer.Step().has_value());
        if (describer.Step()) AddPose(*describer.Step(), print);
      }
      const auto steps = DescribeStream(stream, parts);
      print.Add(steps.size()).Add(SquaredDistance(steps[3], steps[20]));
      AddPose(MeanOf(steps), print);
      AddPose(Mirrored(steps[9], parts), print);
    }
  }
  EXPECT_TRUE(print.Is(24296, 237.58362501));
}

void AddFrame(const SensedFrame& frame, Fingerprint& print) {
  print.Add(frame.body_seen);
  for (const SensedJoint& joint : frame.joints) print.Add(joint.position).Add(joint.state);
}

TEST(Recognition, GoldenStreamsBehindEveryFilter) {
  const std::array<Kept, 5> kept = {{{7176, -740.253825527},
                                     {7176, -784.767404091},
                                     {7176, -737.538428738},
                                     {7176, -804.482919705},
                                     {7176, -808.487660399}}};
  const std::array<FilterOptions, 5> filters = {
      {{},
       {.kind = FilterKind::kHolt},
       {.kind = FilterKind::kHolt,
        .holt = {.smoothing = 0.7,
                 .correction = 0.2,
                 .prediction_frames = 1.5,
                 .jitter_radius_m = 0.02,
                 .max_deviation_radius_m = 0.2}},
       {.kind = FilterKind::kOneEuro},
       {.kind = FilterKind::kOneEuro,
        .one_euro = {.min_cutoff_hz = 2.5, .beta_per_m = 0.5, .derivative_cutoff_hz = 3}}}};
  for (std::size_t i = 0; i < filters.size(); ++i) {
    Fingerprint print;
    const SeenStream seen = SeeStream(NoisyDance(9, i == 2 ? 11 : 30), filters[i]);
    for (std::size_t t = 0; t < seen.frames.size(); t += 3) {
      AddFrame(seen[t].skeleton, print);
      print.Add(seen[t].features.features.values).Add(seen[t].features.states).Add(seen[t].features.body_seen);
    }
    EXPECT_TRUE(print.Is(kept[i].first, kept[i].second)) << i;
  }
}

TEST(Recognition, GoldenKeyPosesAndTheirSequences) {
  Fingerprint pose_print, sequence_print;
  const SeenStream seen = SeeStream(NoisyDance(4), {});
  const auto moves = NoisyMoves(1);
  for (const SightWeights& weights : {SightWeights{}, {.weighting = Weighting::kAdaptive, .not_tracked_weight = 0.1}}) {
    for (const TaughtMove& move : moves) {
      for (const double share : {0.4, 0.8, 1.0}) {
        const KeyPoseOptions options{.tolerance_scale = 1.1, .pose_share = share, .hold_frames = share == 0.8 ? 3 : 1};
        for (const auto& when : WhenReached(move.poses, seen.frames, weights, options)) pose_print.Add(when);
        for (const FeatureFrame& frame : seen.frames) {
          pose_print.Add(MatchOf(frame, move.poses[0], weights, options));
          if (share == 1) pose_print.Add(RuleStrength(frame, move.poses[0], weights, PaperMemberships()));
        }
      }
    }
  }
  for (int trial = 0; trial < 12; ++trial) {
    Dice dice(trial);
    const auto poses = static_cast<std::size_t>(1 + trial % 4);
    PoseSequence sequence(poses, 1 + trial % 3, 2 * trial);
    for (int t = 0; t < 60; ++t) {
      std::vector<double> matches(dice.Below(9) == 0 ? 0 : poses);
      for (double& match : matches) match = dice.Below(7) == 0 ? 0 : std::abs(dice.Signed());
      if (t % 25 == 11) sequence.Open();
      sequence.Update(matches);
      sequence_print.Add(sequence.Asked()).Add(sequence.Spotted());
    }
  }
  EXPECT_TRUE(pose_print.Is(5040, -137.099465301));
  EXPECT_TRUE(sequence_print.Is(1440, 2.20152205919));
}

TEST(Recognition, GoldenDecisions) {
  Fingerprint print;
  Dice dice(8);
  EvidenceTrace trace{.moves = 3, .asked = {}, .spotted = {}};
  for (int t = 0; t < 120; ++t) {
    trace.asked.push_back(std::abs(dice.Signed()));
    for (int move = 0; move < 3; ++move) trace.spotted.push_back(std::abs(dice.Signed()));
  }
  for (const DecisionOptions& options : {DecisionOptions{}, {.threshold = 0.9, .refractory_s = 0.21}}) {
    for (const auto& [move, frame] : FindMoves(trace, 29, options)) print.Add(move).Add(frame);
    for (const FrameInterval& window : {FrameInterval{0, 9}, {30, 31}, {70, 120}}) {
      const Judgement judged = JudgeWindow(trace, window, options.threshold);
      print.Add(judged.recognised_at).Add(judged.score).Add(judged.running_score);
    }
  }
  const SkeletonStream stream = NoisyDance(2, 29);
  for (const double start_s : {-1.0, 0.02, 1.51, 7.0, 90.0}) {
    for (const double end_s : {-0.5, 1.6, 6.02, 99.0}) {
      const FrameInterval between = FramesBetween(start_s, end_s, stream);
      print.Add(between.begin).Add(between.end);
    }
  }
  for (const double rate_hz : {1.0, 9.9, 30.0}) {
    StandingHeight height(rate_hz);
    for (std::size_t t = 0; t < 50; ++t) {
      height.Update(stream.frames[t]);
      print.Add(height.Value());
    }
  }
  EXPECT_TRUE(print.Is(410, -291.094824606));
}

TEST(Recognition, GoldenTrees) {
  const std::array<Kept, 3> kept = {{{167, 163.94559264}, {191, 251.331637304}, {287, -219.583618972}}};
  std::vector<LabelledBag> bags(70);
  Dice dice(21);
  for (LabelledBag& bag : bags) {
    bag.is_right = dice.Below(3) == 0;
    bag.performances.resize(1 + dice.Below(3));
    for (PerformanceMeasures& measures : bag.performances) {
      for (double& measure : measures) measure = dice.Signed();
      measures[3] += bag.is_right ? 0.6 : 0;
      measures[170] *= bag.is_right ? 0.4 : 1;
      measures[11] = std::round(3 * measures[11]);
    }
  }
  const std::array<BoostingOptions, 3> options = {
      {{.trees = 4, .rounds = 1},
       {.trees = 5, .rate = 0.3, .ridge = 1, .least_per_leaf = 3, .takes_turns = true, .rounds = 2},
       {.trees = 9, .rate = 0.2, .ridge = 0.5, .least_per_leaf = 20, .rounds = 3}}};
  for (std::size_t i = 0; i < options.size(); ++i) {
    const BoostedTrees model = FitBoostedTrees(bags, options[i]);
    Fingerprint print;
    print.Add(model.bias);
    for (const DecisionTree& tree : model.trees) {
      print.Add(tree.measures).Add(tree.leaves);
      for (const double limit : tree.limits) print.Add(limit == 1e9 ? 2 : limit);  // everything is at most that
    }
    for (const LabelledBag& bag : bags) print.Add(model.Probability(bag.performances.back()));
    EXPECT_TRUE(print.Is(kept[i].first, kept[i].second)) << i;
  }
}

}  // namespace
}  // namespace etude
