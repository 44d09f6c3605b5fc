#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/transitions/choices/choice.h"
#include "tests/engine/transitions/random_clips.h"

namespace etude {
namespace {

struct Trial {
  MotionLibrary library;
  std::vector<TransitionRequest> requests;
};

/// Returns a small library, and a request that is likely to go wrong.
Trial DrawTrial(int number) {
  RandomStream dice({.suite_seed = 6, .scenario = "switch-clips", .trial = number}, "library");
  std::vector<int> lengths(2 + number % 3);
  for (int& length : lengths) length = dice.Chance(0.3) ? 2 : 3 + static_cast<int>(dice.IndexBelow(90));
  Trial trial{.library = RandomLibrary(dice, lengths), .requests = {}};
  for (int i = 0; i < 4; ++i) {
    TransitionRequest request;
    request.from = static_cast<int>(dice.IndexBelow(lengths.size()));
    request.to = static_cast<int>(dice.IndexBelow(lengths.size()));
    const int last = lengths[request.from] - 1;
    request.request_frame = i == 0 ? last : static_cast<int>(dice.IndexBelow(last + 1));
    request.budget_s = std::array{0.0, 60.0, 1.0, 0.5}[i];
    trial.requests.push_back(request);
  }
  return trial;
}

void ExpectAddsUp(const FuzzyDistance& distance) {
  const double sum = std::accumulate(distance.partials.begin(), distance.partials.end(), 0.0);
  EXPECT_NEAR(sum, distance.value * distance.value, 1e-12);
}

void ExpectSegmentsChain(const TransitionRecord& record, const MotionLibrary& library,
                         const TransitionRequest& request) {
  const Segment &first = record.segments.front(), &last = record.segments.back();
  EXPECT_EQ(first.clip, request.from);
  EXPECT_EQ(first.first, request.request_frame);
  EXPECT_EQ(last.clip, record.branch == Branch::kUnbroken ? request.from : request.to);
  EXPECT_EQ(last.last, library.tagged[last.clip].FrameCount() - 1);
  for (std::size_t i = 0; i < record.segments.size(); ++i) {
    const Segment& segment = record.segments[i];
    const int frames = segment.clip == Segment::kOwnFrames ? static_cast<int>(segment.own.size())
                                                           : library.tagged[segment.clip].FrameCount();
    EXPECT_GE(segment.first, 0);
    EXPECT_LE(segment.first + (i > 0 ? 1 : 0), segment.last) << "something of it is shown";
    EXPECT_LT(segment.last, frames);
    EXPECT_EQ(segment.own.empty(), segment.clip != Segment::kOwnFrames);
  }
}

void ExpectCandidates(const TransitionRecord& record) {
  EXPECT_LE(record.candidates.size(), kMaxCandidates);
  EXPECT_LE(record.pairs_matched, record.pairs_seen);
  for (const Candidate& candidate : record.candidates) ExpectAddsUp(candidate.distance);
  const auto taken = std::count_if(record.candidates.begin(), record.candidates.end(),
                                   [](const Candidate& c) { return c.outcome == CandidateOutcome::kTaken; });
  EXPECT_EQ(static_cast<std::size_t>(taken), record.candidates.empty() ? 0 : record.distances.size());
}

constexpr double kMaxLength_s = 60;  // seconds, the largest setting of `played`

/// Returns the longest wait, seconds, that the record's branch permits.
double LatestWait(const TransitionRecord& record, const MotionLibrary& library, const TransitionRequest& request) {
  const TaggedClip& playing = library.tagged[request.from];
  const double tweens = LongestInBetween(library.in_betweens.tween, playing.rate_hz);
  const double rest = (playing.FrameCount() - 1 - request.request_frame) / playing.rate_hz;
  switch (record.branch) {
    case Branch::kNow:
    case Branch::kUnbroken:
      return 0;
    case Branch::kEnd:
      return rest;
    case Branch::kStandingPose:
      return tweens;
    case Branch::kInBetween:
      if (record.segments[1].clip != Segment::kOwnFrames) return std::min(request.budget_s, rest) + kMaxLength_s;
      [[fallthrough]];
    case Branch::kForced:
      return std::min(request.budget_s, rest) + tweens;
    default:
      return std::min(request.budget_s, rest);
  }
}

void ExpectSound(const BodyMotion& motion, const BodyProportions& proportions) {
  for (const BodyPose& pose : motion.poses) {
    for (const glm::dvec3& joint : pose.joints) ASSERT_TRUE(std::isfinite(joint.x + joint.y + joint.z));
    for (const Bone& bone : AllBones()) {
      ASSERT_NEAR(BoneLength(pose, bone), proportions.limb_lengths[Index(bone.child)], 1e-9) << RoleName(bone.child);
    }
  }
}

void ExpectSame(const Transition& a, const Transition& b) {
  EXPECT_EQ(a.record.why, b.record.why);
  ASSERT_EQ(a.splice.motion.poses.size(), b.splice.motion.poses.size());
  for (std::size_t f = 0; f < a.splice.motion.poses.size(); ++f) {
    ASSERT_EQ(a.splice.motion.poses[f].joints, b.splice.motion.poses[f].joints);
  }
}

/// Checks a transition; returns true if one was found.
bool CheckTransition(const MotionLibrary& library, const TransitionRequest& request, const TransitionWay& method) {
  const Transition result = MakeTransition(library, request, method);
  const TransitionRecord& record = result.record;
  EXPECT_FALSE(record.why.empty());
  if (record.segments.empty() && method.choice->name == "played") {
    EXPECT_NE(record.why.find("and no clip shows within"), std::string::npos) << record.why;
    return false;
  }
  if (record.segments.empty()) {
    EXPECT_EQ(method.choice->name, "unbroken") << record.why;
    EXPECT_EQ(request.request_frame, library.tagged[request.from].FrameCount() - 1);
    return false;
  }
  ExpectSegmentsChain(record, library, request);
  EXPECT_EQ(record.distances.size(), record.segments.size() - 1);
  EXPECT_EQ(result.splice.points.size(), record.distances.size());
  for (const FuzzyDistance& distance : record.distances) ExpectAddsUp(distance);
  ExpectCandidates(record);
  EXPECT_EQ(record.wait_s, WaitOf(record.segments, kJudgedRateHz));
  EXPECT_LE(record.wait_s, LatestWait(record, library, request) + 1e-9);
  int frames = record.segments.front().last + 1;
  for (std::size_t i = 1; i < record.segments.size(); ++i) frames += record.segments[i].last - record.segments[i].first;
  EXPECT_EQ(result.splice.motion.poses.size(), static_cast<std::size_t>(frames));
  ExpectSound(result.splice.motion, library.proportions);
  ExpectSame(result, MakeTransition(library, request, method));
  return true;
}

class EveryChoice : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryChoice, WithEveryJoinKeepsItsPromisesOnRandomLibraries) {
  int found = 0;
  for (int number = 0; number < 12 && !HasFailure(); ++number) {
    const Trial trial = DrawTrial(number);
    for (const TransitionRequest& request : trial.requests) {
      for (const JoinKind& join : AllJoins()) {
        SCOPED_TRACE(::testing::Message() << "library " << number << ", clip " << request.from << " frame "
                                          << request.request_frame << " to " << request.to << ", " << join.name);
        found += CheckTransition(
            trial.library, request,
            {.choice = FindChoice(GetParam()), .join = &join, .rules = {}, .choice_settings = {}, .join_settings = {}});
      }
    }
  }
  EXPECT_GT(found, 100) << "of 192";
}

INSTANTIATE_TEST_SUITE_P(All, EveryChoice, ::testing::ValuesIn(ChoiceNames()), [](const auto& parameter) {
  std::string name = parameter.param;
  std::erase(name, '-');
  return name;
});

/// Returns the default settings, each time with one setting at its lowest or largest value.
std::vector<std::vector<double>> Extremes(std::span<const NumberSetting> settings) {
  std::vector<double> defaults;
  for (const NumberSetting& setting : settings) defaults.push_back(setting.fallback);
  std::vector<std::vector<double>> extremes;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    for (double value : {settings[i].lowest, settings[i].largest}) {
      extremes.push_back(defaults);
      extremes.back()[i] = value;
    }
  }
  return extremes;
}

TEST(MakeTransition, TakesSettingsToTheirLimits) {
  const Trial trial = DrawTrial(4);
  int tried = 0;
  const auto check = [&](const TransitionWay& way) {
    ++tried;
    for (const TransitionRequest& request : trial.requests) CheckTransition(trial.library, request, way);
  };
  for (const Choice& choice : AllChoices()) {
    for (const std::vector<double>& values : Extremes(choice.settings)) {
      check({.choice = &choice, .join = &AllJoins()[0], .rules = {}, .choice_settings = values, .join_settings = {}});
    }
  }
  for (const JoinKind& join : AllJoins()) {
    for (const std::vector<double>& values : Extremes(join.settings)) {
      check({.choice = &AllChoices()[0], .join = &join, .rules = {}, .choice_settings = {}, .join_settings = values});
    }
  }
  EXPECT_EQ(tried, 2 * (8 + 10)) << "eight settings of choices, ten of joins";
}

// Dead blending continues the clip by extrapolation, so it differs here.
TEST(Unbroken, IsTheClipItselfByAnyJoinButDeadBlending) {
  const Trial trial = DrawTrial(5);
  const TransitionRequest request{.from = 1, .request_frame = 1, .to = 0};
  ASSERT_GT(trial.library.motions[1].poses.size(), 2u);
  for (const JoinKind& join : AllJoins()) {
    const Transition result = MakeTransition(
        trial.library, request,
        {.choice = FindChoice("unbroken"), .join = &join, .rules = {}, .choice_settings = {}, .join_settings = {}});
    const std::vector<BodyPose>&clip = trial.library.motions[1].poses, &shown = result.splice.motion.poses;
    ASSERT_EQ(shown.size(), clip.size());
    double farthest = 0;
    for (std::size_t f = 0; f < clip.size(); ++f) {
      for (Role role : AllRoles()) farthest = std::max(farthest, glm::distance(shown[f][role], clip[f][role]));
    }
    EXPECT_EQ(farthest > 1e-9, join.name == "dead-blending") << join.name << ' ' << farthest;
  }
}

}  // namespace
}  // namespace etude
