#include "sim/choreography/sequence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "sim/choreography/stance.h"

namespace etude {
namespace {

const Move& Boxing() {
  static const Move move = LoadBuiltinMove("boxing").value();
  return move;
}
const Move& Kick() {
  static const Move move = LoadBuiltinMove("side_kick").value();
  return move;
}

/// A bar of waiting, boxing from beat 4, kicks from beat 12 in half time, waiting again from beat 28.
std::vector<Turn> Turns() {
  return {{.start_beat = 0, .beats = 4},
          {.start_beat = 4, .beats = 8, .move = &Boxing()},
          {.start_beat = 12, .beats = 16, .move = &Kick(), .pace = 0.5},
          {.start_beat = 28, .beats = 4}};
}

double Difference(const Controls& a, const Controls& b) {
  double worst = 0;
  for (std::size_t i = 0; i < kControlCount; ++i) worst = std::max(worst, std::abs(a.values[i] - b.values[i]));
  return worst;
}

TEST(SequenceAt, DancesEachTurnAtItsPaceOutsideTheBlends) {
  const std::vector<Turn> turns = Turns();
  for (double beat : {4.5, 7.3, 11.0}) EXPECT_EQ(SequenceAt(turns, beat).values, Boxing().curves.At(beat - 4).values);
  for (double beat : {12.5, 20.0, 27.0}) {
    EXPECT_EQ(SequenceAt(turns, beat).values, Kick().curves.At(0.5 * (beat - 12)).values);
  }
  EXPECT_GT(Difference(SequenceAt(turns, 11.5), Boxing().curves.At(7.5)), 0.05) << "the control: within a blend";
}

TEST(SequenceAt, BeginsAndEndsInTheReadyStance) {
  for (double beat : {-3.0, 0.0, 32.0, 40.0}) {
    Controls at = SequenceAt(Turns(), beat);
    at[MiddleControl::kHipsDrop] = ReadyStance()[MiddleControl::kHipsDrop];  // the knees give way to the music
    EXPECT_LT(Difference(at, ReadyStance()), 1e-12) << beat;
  }
  for (double beat : {0.0, 32.0}) EXPECT_LT(Difference(SequenceAt(Turns(), beat), ReadyStance()), 1e-12);
}

TEST(SequenceAt, HasNoStepInPlaceOrSpeed) {
  const std::vector<Turn> turns = Turns();
  constexpr double kStep = 1e-5;
  double fastest = 0;
  for (double change : {4.0, 12.0, 28.0}) {
    for (double beat : {change - kBlendBeatsBefore, change, change + kBlendBeatsAfter}) {
      const Controls before = SequenceAt(turns, beat - kStep), at = SequenceAt(turns, beat),
                     after = SequenceAt(turns, beat + kStep);
      for (std::size_t i = 0; i < kControlCount; ++i) {
        const double arriving = (at.values[i] - before.values[i]) / kStep;
        const double leaving = (after.values[i] - at.values[i]) / kStep;
        EXPECT_NEAR(arriving, leaving, 0.01) << "control " << i << " at beat " << beat;
        fastest = std::max(fastest, std::abs(leaving));
      }
    }
  }
  EXPECT_GT(fastest, 0.5) << "there must be speed for the comparison to mean anything";
}

TEST(SequenceAt, LeavesTheFeetToOneTurnAtATime) {
  const std::vector<Turn> turns = Turns();
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (SideControl control : {SideControl::kLegFree, SideControl::kLegSide, SideControl::kFootSide,
                                SideControl::kFootAhead, SideControl::kFootLift, SideControl::kFootTurn}) {
      // In its blend the turn before has come to beat 8 of its 8; the kick's clock stands before its beginning.
      for (double beat : {11.1, 11.6, 11.99}) {
        EXPECT_EQ(SequenceAt(turns, beat).Of(side, control), Boxing().curves.At(beat - 4).Of(side, control));
      }
      for (double beat : {12.01, 12.3}) {
        EXPECT_EQ(SequenceAt(turns, beat).Of(side, control), Kick().curves.At(0.5 * (beat - 12)).Of(side, control));
      }
    }
  }
}

}  // namespace
}  // namespace etude
