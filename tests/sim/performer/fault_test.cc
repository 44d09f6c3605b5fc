#include "sim/performer/fault.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "engine/base/angles.h"
#include "sim/choreography/canonical_body.h"
#include "sim/performer/rendition.h"
#include "tests/sim/performer/all_moves.h"

namespace etude {
namespace {

/// Returns a standing body with the right arm raised sideways by `degrees`.
BodyPose ArmRaised(double degrees) {
  BodyPose pose = StandingPose();
  const glm::dvec3 shoulder = pose[Role::kRightShoulder];
  const double a = Radians(degrees);
  for (Role role : {Role::kRightElbow, Role::kRightWrist, Role::kRightHand}) {
    pose[role] = shoulder + glm::distance(pose[role], shoulder) * glm::dvec3(-std::sin(a), -std::cos(a), 0);
  }
  return pose;
}

TEST(PerformanceDeviation, OfOneLimbIsItsAngle) {
  const auto meant = [](double) { return ArmRaised(30); };
  EXPECT_NEAR(LimbDeviationDeg(meant, [](double) { return ArmRaised(50); }), 20, 1e-6);
  EXPECT_EQ(LimbDeviationDeg(meant, meant), 0);
  // The arm is 20° off for a quarter of the time: the RMS is 20° times the square root of a quarter.
  EXPECT_NEAR(LimbDeviationDeg(meant, [](double share) { return ArmRaised(share < 0.25 ? 50 : 30); }), 10, 1e-6);
  // A linear rise to 60 degrees away has the RMS 60 / √3, up to the error of 32 samples.
  EXPECT_NEAR(LimbDeviationDeg(meant, [](double share) { return ArmRaised(30 + 60 * share); }), 60 / std::sqrt(3),
              0.02);
}

TEST(PerformanceDeviation, OfTheClockIsCountedInBeats) {
  const auto even = [](double due) { return due; };
  EXPECT_EQ(TimingDeviationBeats(even, even, 4), 0);
  // One beat of four late: the lag rises to 1 beat in the first beat, and stays 1 in the others. √((1/3 + 3) / 4).
  EXPECT_NEAR(TimingDeviationBeats(
                  even, [](double due) { return due - 0.25; }, 4),
              std::sqrt((1.0 / 3 + 3) / 4), 1e-3);
  // A sine whose amplitude is 0.1 of the eight beats, which is 0.8 beats, has the RMS 0.8 / √2.
  EXPECT_NEAR(TimingDeviationBeats(
                  even, [](double due) { return due + 0.1 * std::sin(kPi * due); }, 8),
              0.8 / std::sqrt(2), 1e-2);
}

TEST(PerformanceDeviation, DecidesWhatIsRightGreyAndWrong) {
  const DeviationLimits limits{.right = {10, 0.2}, .wrong = {20, 0.4}};
  EXPECT_EQ(TruthOf({10, 0.2}, limits), Truth::kRight);
  EXPECT_EQ(TruthOf({10.1, 0.2}, limits), Truth::kGrey);
  EXPECT_EQ(TruthOf({10, 0.21}, limits), Truth::kGrey);
  EXPECT_EQ(TruthOf({20, 0.4}, limits), Truth::kGrey);
  EXPECT_EQ(TruthOf({20.1, 0}, limits), Truth::kWrong);
  EXPECT_EQ(TruthOf({0, 0.41}, limits), Truth::kWrong);
  EXPECT_EQ(TruthOf({}, limits), Truth::kRight);
}

TEST(PerformanceDeviation, IsOfThePersonsOwnMotionSoThatNoHabitIsAFault) {
  for (People people : {People::kToddler, People::kAdult}) {
    const Person person = DrawPerson({3, "stray", 1}, people);
    for (const Move& move : AllMoves()) {
      const Style style(person, move);
      const Rendition rendition(style, {.tempo = 0.7, .unevenness = 0.2, .ways = 9}, {});
      const PerformanceDeviation deviation = rendition.Deviation();
      EXPECT_EQ(deviation.limb_deg, 0) << move.name;
      EXPECT_EQ(deviation.timing_beats, 0) << move.name;
    }
  }
}

/// Returns a number that grows with `limb_deg` and with `timing_beats`.
double Badness(const PerformanceDeviation& deviation) { return deviation.limb_deg / 25 + deviation.timing_beats / 0.5; }

TEST(PerformanceDeviation, GrowsWithTheSeverityOfEveryFault) {
  const Person person = DrawPerson({3, "stray", 2}, People::kMixed);
  std::map<Fault, int> shown;
  for (const Move& move : AllMoves()) {
    const Move& instead = AllMoves()[(&move - AllMoves().data() + 1) % AllMoves().size()];
    const Style style(person, move), other(person, instead);
    for (Fault fault : AllFaults()) {
      for (double choice : {0.1, 0.9}) {
        if (!CanShow({fault, 1, choice}, move, &instead)) continue;
        ++shown[fault];
        double before = 0;
        for (double severity : {0.0, 0.2, 0.4, 0.6, 0.8, 1.0}) {
          const Rendition rendition(style, {}, {{fault, severity, choice}}, &other);
          const double badness = Badness(rendition.Deviation());
          if (severity == 0) {
            EXPECT_NEAR(badness, 0, 1e-9) << move.name << " " << FaultName(fault);
          }
          EXPECT_GE(badness, before - 1e-3) << move.name << " " << FaultName(fault) << " " << severity;
          before = badness;
        }
        EXPECT_NE(TruthOf(Rendition(style, {}, {{fault, 1, choice}}, &other).Deviation()), Truth::kRight)
            << move.name << " " << FaultName(fault);
      }
    }
  }
  EXPECT_EQ(shown.size(), AllFaults().size()) << "every fault can be shown by some move";
}

TEST(Faults, OnlyOneSidedMovesCanBeDancedOnTheWrongSide) {
  const auto can = [](const char* name, Fault fault) {
    return CanShow({fault, 1, 0}, LoadBuiltinMove(name).value(), nullptr);
  };
  EXPECT_TRUE(can("side_kick", Fault::kWrongSide));
  EXPECT_TRUE(can("side_stretch", Fault::kWrongSide));
  EXPECT_FALSE(can("boxing", Fault::kWrongSide)) << "it comes round to the other side anyway";
  EXPECT_FALSE(can("clap", Fault::kWrongSide));
  for (const Move& move : AllMoves()) {
    EXPECT_TRUE(can(move.name.c_str(), Fault::kAmplitude)) << move.name;
    EXPECT_TRUE(can(move.name.c_str(), Fault::kSkipped)) << move.name;
    EXPECT_TRUE(can(move.name.c_str(), Fault::kLate)) << move.name;
  }
}

TEST(Rendition, FindsWhenAShareIsDanced) {
  const Person person;
  const Move clap = LoadBuiltinMove("clap").value();
  const Style style(person, clap);
  const Rendition late(style, {}, {{Fault::kLate, 1, 0}}), off(style, {.unevenness = 0.2}, {{Fault::kOffBeat, 1, 0}});
  EXPECT_NEAR(late.DueOf(0.5), 0.75, 1e-9) << "one beat of four";
  for (double due = 0.05; due < 1; due += 0.1) EXPECT_NEAR(off.DueOf(off.DancedShare(due)), due, 1e-6);
}

}  // namespace

}  // namespace etude
