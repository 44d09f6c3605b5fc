#include "sim/performer/learner.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/sim/performer/all_moves.h"

namespace etude {
namespace {

constexpr WorldKey kLearnerWorld{3, "learner-test", 4};

const ShowableFaults& AllShowable() {
  static const ShowableFaults showable(AllMoves());
  return showable;
}

std::size_t IndexOf(const char* name) {
  return static_cast<std::size_t>(std::ranges::find(AllMoves(), name, &Move::name) - AllMoves().begin());
}

/// A learner, and functions by which a test shows it a coach's dance and acts.
class Coaching {
 public:
  explicit Coaching(const LearnerOptions& options = {}, People people = People::kAdult, int trial = 4)
      : learner_(Key(trial), DrawPerson(Key(trial), people), AllMoves(), AllShowable(), options) {}

  Learner& learner() { return learner_; }
  /// Returns the retained probability that a performance of this move is right.
  double Kept(std::size_t move) const { return learner_.RetainedChanceOfRight(move, 0); }
  const std::vector<BodyPose>& poses() const { return poses_; }

  void Show(const Shown& shown) { poses_.push_back(learner_.Step(shown)); }
  /// Dances a move once, or only its first `beats`; returns its truth.
  Truth Dance(std::size_t move, double beats = 1e9) {
    const Move& danced = AllMoves()[move];
    const double per_frame = danced.tempo_bpm / 60 / kJudgedRateHz;
    ++repetition_;
    for (double beat = 0; beat < std::min(beats, danced.beats); beat += per_frame) {
      Show({.act = Shown::Act::kDance, .move = static_cast<int>(move), .repetition = repetition_, .beat = beat});
    }
    return learner_.performances().back().event.truth;
  }
  void Do(Shown::Act act, std::size_t move, int frames = 45) {
    for (int i = 0; i < frames; ++i) Show({.act = act, .move = static_cast<int>(move)});
  }
  void Wait(int frames = 30) {
    for (int i = 0; i < frames; ++i) Show({});
  }
  void Praise() {
    Show({.praises = true});
    Show({});
  }
  void Correct(std::size_t move) { Do(Shown::Act::kCorrect, move); }
  /// Dances a move again and again until a performance has this truth.
  void DanceUntil(std::size_t move, Truth truth) {
    for (int i = 0; i < 40; ++i) {
      const Truth was = Dance(move);
      Wait(3);
      if (was == truth) return;
    }
    FAIL() << "never " << TruthName(truth);
  }

 private:
  static WorldKey Key(int trial) { return {3, "learner-test", trial}; }

  Learner learner_;
  std::vector<BodyPose> poses_;
  int repetition_ = -1;
};

TEST(Learner, WhoCanDoEverythingIsAlwaysRight) {
  Coaching coaching({.skill = 1.0}, People::kExpert);
  for (std::size_t move = 0; move < AllMoves().size(); ++move) {
    for (int i = 0; i < 3; ++i) EXPECT_EQ(coaching.Dance(move), Truth::kRight);
    EXPECT_EQ(coaching.learner().ChanceOfRight(move), 1);
  }
  coaching.Wait();
  for (const LearnerPerformance& performance : coaching.learner().performances()) {
    EXPECT_TRUE(performance.is_over);
    EXPECT_FALSE(performance.is_cut);
    ASSERT_TRUE(performance.event.first_right_s);
    EXPECT_GT(*performance.event.first_right_s, performance.event.start_s);
    EXPECT_LT(*performance.event.first_right_s, performance.event.end_s + 0.05);
  }
}

TEST(Learner, MakesFullMistakesWhereAskedTo) {
  Coaching thrown({.skill = 0.1}), full({.skill = 0.1, .severity = 1.0});
  int faults = 0;
  for (std::size_t move = 0; move < AllMoves().size(); ++move) {
    for (int i = 0; i < 3; ++i) {
      thrown.Dance(move);
      full.Dance(move);
    }
  }
  for (std::size_t i = 0; i < full.learner().performances().size(); ++i) {
    const auto& as_thrown = thrown.learner().performances()[i].event.faults;
    const auto& as_asked = full.learner().performances()[i].event.faults;
    ASSERT_EQ(as_thrown.size(), as_asked.size());  // the same draws
    for (std::size_t f = 0; f < as_asked.size(); ++f) {
      EXPECT_EQ(as_asked[f].fault, as_thrown[f].fault);
      EXPECT_EQ(as_asked[f].severity, 1);
      EXPECT_LT(as_thrown[f].severity, 1);
      ++faults;
    }
  }
  EXPECT_GT(faults, 10);
}

TEST(Learner, WhoIsAbsentIsNeverRight) {
  Coaching coaching({}, People::kAbsent);
  for (std::size_t move = 0; move < AllMoves().size(); ++move) EXPECT_EQ(coaching.Dance(move), Truth::kWrong);
}

TEST(Learner, DoesWhatIsShownOneLagLater) {
  const std::size_t jump = IndexOf("jump");
  for (People people : {People::kExpert, People::kToddler}) {
    Coaching coaching({.skill = 1.0}, people);
    coaching.Wait();
    for (int i = 0; i < 3; ++i) coaching.Dance(jump);
    coaching.Wait(60);
    // The jump's top is at beat 2.
    for (const LearnerPerformance& performance : coaching.learner().performances()) {
      const double top_shown_s = performance.event.start_s + 2 * 60 / AllMoves()[jump].tempo_bpm;
      const auto from = static_cast<std::size_t>(performance.event.start_s * 30), to = from + 75;
      std::size_t top = from;
      for (std::size_t i = from; i < to; ++i) {
        const auto height = [&](std::size_t k) { return coaching.poses()[k][Role::kHipCentre].y; };
        if (height(i) > height(top)) top = i;
      }
      const double lag = static_cast<double>(top) / 30 - top_shown_s;
      EXPECT_NEAR(lag, performance.event.chance.lag_s, 0.25) << PeopleNames()[static_cast<std::size_t>(people)];
      EXPECT_NEAR(*performance.event.first_right_s - top_shown_s, performance.event.chance.lag_s, 0.15);
    }
  }
}

TEST(Learner, IsCausal) {
  // The coaches act alike for two seconds, then differ.
  Coaching one, other;
  for (Coaching* coaching : {&one, &other}) {
    coaching->Wait(20);
    coaching->Dance(IndexOf("clap"));
  }
  const std::size_t same = one.poses().size();
  one.Dance(IndexOf("boxing"));
  other.Correct(IndexOf("clap"));
  for (std::size_t i = 0; i < same; ++i) EXPECT_EQ(one.poses()[i].joints, other.poses()[i].joints);
  EXPECT_NE(one.poses()[same + 20].joints, other.poses()[same + 20].joints);
}

TEST(Learner, MovesSmoothlyThroughWhateverIsShown) {
  Coaching coaching({}, People::kSchoolChild);
  for (int round = 0; round < 2; ++round) {
    for (std::size_t move = 0; move < AllMoves().size(); ++move) {
      coaching.Dance(move);
      coaching.Dance(move, 1.3);  // cut short
      coaching.Correct(move);
      coaching.Do(Shown::Act::kDemonstrate, move, 60);
    }
  }
  double worst = 0;
  const auto& poses = coaching.poses();
  for (std::size_t i = 2; i < poses.size(); ++i) {
    for (Role role : AllRoles()) {
      worst = std::max(worst, glm::length(poses[i][role] - 2.0 * poses[i - 1][role] + poses[i - 2][role]));
    }
  }
  EXPECT_LT(worst, 0.3);
}

std::vector<std::string> LuckOf(const Learner& learner, std::size_t move) {
  std::vector<std::string> luck;
  for (const LearnerPerformance& performance : learner.performances()) {
    if (performance.move != static_cast<int>(move)) continue;
    std::string text = FaultNames(performance.event.faults);
    for (const GradedFault& fault : performance.event.faults) text += " " + std::to_string(fault.severity);
    luck.push_back(text + " lag " + std::to_string(performance.event.chance.lag_s));
  }
  return luck;
}

TEST(Learner, MeetsTheSameLuckUnderEveryCoach) {
  // Nothing is learnt, so only chance remains.
  const LearnerOptions options{.rates = {.rate = 1e-12}, .skill = 0.2, .gives_up = false};
  Coaching plain(options), busy(options);
  const std::size_t clap = IndexOf("clap"), sway = IndexOf("sway");
  for (int i = 0; i < 6; ++i) plain.Dance(clap);
  for (int i = 0; i < 6; ++i) plain.Dance(sway);
  for (int i = 0; i < 6; ++i) {
    busy.Dance(sway);
    busy.Wait(17);
    busy.Dance(clap);
    busy.Wait(5);
    busy.Praise();
  }
  EXPECT_EQ(LuckOf(plain.learner(), clap), LuckOf(busy.learner(), clap));
  EXPECT_EQ(LuckOf(plain.learner(), sway), LuckOf(busy.learner(), sway));
  EXPECT_NE(LuckOf(plain.learner(), clap), LuckOf(plain.learner(), sway));
}

TEST(Learner, LessSkillNeverTakesAFaultAway) {
  const std::size_t robot = IndexOf("robot");
  const auto faults = [&](double skill) {
    Coaching coaching({.rates = {.rate = 1e-12}, .skill = skill});
    int count = 0;
    for (int i = 0; i < 12; ++i) {
      coaching.Dance(robot);
      count += static_cast<int>(coaching.learner().performances().back().event.faults.size());
    }
    return count;
  };
  EXPECT_EQ(faults(1), 0);
  EXPECT_LE(faults(0.7), faults(0.4));
  EXPECT_LE(faults(0.4), faults(0.1));
  EXPECT_GT(faults(0.1), faults(1));
}

class UnderEveryLaw : public ::testing::TestWithParam<LearningLaw> {
 protected:
  LearnerOptions Options() const { return {.law = GetParam(), .skill = 0.4}; }

  const std::size_t clap = IndexOf("clap"), sway = IndexOf("sway"), bird = IndexOf("bird");
  Coaching coaching{Options()};
};

TEST_P(UnderEveryLaw, ACorrectionOfAMistakeTeachesAndOneWithoutCostsPatience) {
  Coaching contingent(Options()), needless(Options());
  contingent.DanceUntil(clap, Truth::kWrong);
  needless.DanceUntil(clap, Truth::kRight);
  const double wrong_before = contingent.Kept(clap);
  const double right_before = needless.Kept(clap);
  const double patience = contingent.learner().patience();
  contingent.Correct(clap);
  needless.Correct(clap);
  EXPECT_GT(contingent.Kept(clap), wrong_before + 0.005);
  EXPECT_EQ(needless.Kept(clap), right_before);
  EXPECT_LT(needless.learner().patience(), contingent.learner().patience());
  const double once = contingent.learner().patience();
  EXPECT_GT(once, patience - 0.05);
  contingent.Wait();
  contingent.Correct(clap);
  EXPECT_LT(contingent.learner().patience(), once - 0.1) << "a mistake is corrected once";
}

TEST_P(UnderEveryLaw, ACorrectionAboutAnotherMoveTeachesNothing) {
  coaching.DanceUntil(clap, Truth::kWrong);
  const double before = coaching.Kept(clap);
  coaching.Correct(sway);
  EXPECT_EQ(coaching.Kept(clap), before);
}

TEST_P(UnderEveryLaw, PracticeAndDemonstrationTeach) {
  double before = coaching.Kept(bird);
  coaching.Dance(bird);
  coaching.Wait();
  EXPECT_GT(coaching.Kept(bird), before);
  const double practised = coaching.Kept(bird);
  coaching.Do(Shown::Act::kDemonstrate, bird);
  EXPECT_GT(coaching.Kept(bird) - practised, practised - before);
}

TEST_P(UnderEveryLaw, APerformanceThatIsCutIsNone) {
  const double before = coaching.Kept(bird);
  coaching.Dance(bird, 2);
  coaching.Wait();
  EXPECT_TRUE(coaching.learner().performances().back().is_cut);
  EXPECT_EQ(coaching.Kept(bird), before);
}

TEST_P(UnderEveryLaw, PraiseForAMistakeUnteachesAndCostsPatience) {
  coaching.DanceUntil(clap, Truth::kRight);
  coaching.Correct(clap);  // patience below one, so that it can rise
  const double spent = coaching.learner().patience();
  coaching.Praise();
  EXPECT_GT(coaching.learner().patience(), spent);
  coaching.DanceUntil(clap, Truth::kWrong);
  const double before = coaching.Kept(clap), patience = coaching.learner().patience();
  coaching.Praise();
  EXPECT_LT(coaching.Kept(clap), before);
  EXPECT_LT(coaching.learner().patience(), patience);
}

TEST_P(UnderEveryLaw, FeedbackHelpsAtOnceMoreThanItLasts) {
  coaching.DanceUntil(clap, Truth::kWrong);
  const double now = coaching.learner().ChanceOfRight(clap), later = coaching.Kept(clap);
  coaching.Correct(clap);
  EXPECT_GT(coaching.learner().ChanceOfRight(clap) - now, coaching.Kept(clap) - later);
}

TEST_P(UnderEveryLaw, TheMoreFrequentFeedbackTheLessEachTeaches) {
  const auto gain = [&](bool fed_before) {
    LearnerOptions options = Options();
    options.skill = 0.6;
    Coaching taught(options);
    for (int i = 0; i < 5; ++i) {
      taught.Dance(clap);
      taught.Wait(3);
      if (fed_before) taught.Do(Shown::Act::kDemonstrate, clap, 3);
    }
    // The two learners differ in how much they have left to learn, so the gain is measured as a share of it.
    const double before = 1 - taught.Kept(clap);
    taught.Wait(3);
    taught.Do(Shown::Act::kDemonstrate, clap, 3);
    return (before - (1 - taught.Kept(clap))) / before;
  };
  EXPECT_LT(gain(true), 0.9 * gain(false));
}

TEST_P(UnderEveryLaw, WhoIsInterruptedForNothingGivesUpAndStands) {
  int corrections = 0;
  while (!coaching.learner().HasGivenUp() && corrections < 20) {
    coaching.DanceUntil(clap, Truth::kRight);
    coaching.Correct(clap);
    ++corrections;
  }
  EXPECT_GE(corrections, 4);
  EXPECT_LE(corrections, 10);
  EXPECT_EQ(coaching.Dance(clap), Truth::kWrong);
  coaching.Wait(20);
  EXPECT_EQ(coaching.learner().performances().back().event.danced, "");
  EXPECT_EQ(coaching.learner().patience(), 0);
}

INSTANTIATE_TEST_SUITE_P(Laws, UnderEveryLaw,
                         ::testing::Values(LearningLaw::kExponential, LearningLaw::kPower, LearningLaw::kTwoRate),
                         [](const auto& tested) {
                           std::string name = LearningLawNames()[static_cast<std::size_t>(tested.param)];
                           std::erase(name, '-');
                           return name;
                         });

TEST(ShowableFaults, KnowWhatEachMoveCanShow) {
  for (std::size_t i = 0; i < AllMoves().size(); ++i) {
    EXPECT_GE(AllShowable().Of(i).size(), 5u) << AllMoves()[i].name;
    EXPECT_TRUE(std::ranges::is_sorted(AllShowable().Of(i), {}, &GradedFault::fault));
  }
  const Move clap = LoadBuiltinMove("clap").value();
  const ShowableFaults alone({&clap, 1});
  EXPECT_TRUE(std::ranges::none_of(alone.Of(0), [](const GradedFault& f) { return f.fault == Fault::kWrongMove; }));
}

}  // namespace
}  // namespace etude
