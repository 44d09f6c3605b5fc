#include "sim/choreography/sequence.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/smoothstep.h"
#include "sim/choreography/stance.h"

namespace etude {
namespace {

Controls Waiting(double beat) {
  constexpr double kGive = 0.015;  // metres
  Controls waiting = ReadyStance();
  waiting[MiddleControl::kHipsDrop] += kGive * 0.5 * (1 - std::cos(2 * kPi * beat));
  return waiting;
}

/// A clock that stands until -`lead`, gathers way, and runs with the music from 0 on.
double StartingClock(double time, double lead) {
  if (time >= 0) return time;
  const double t = std::max(time, -lead) + lead;
  return 0.5 * (t * t / lead - lead);
}

/// A turn's own clock, beats: runs with the music within the turn, gathers way in the blend before, and comes to rest
/// in the blend after, so that nobody starts a gesture that is not to be.
double ClockOf(const Turn& turn, double beat) {
  const double since = beat - turn.start_beat;
  if (since > turn.beats) return turn.beats - StartingClock(turn.beats - since, kBlendBeatsAfter);
  return StartingClock(since, kBlendBeatsBefore);
}

Controls TurnAt(const Turn& turn, double beat) {
  const double clock = ClockOf(turn, beat);
  return turn.move ? turn.move->curves.At(turn.pace * clock) : Waiting(clock);
}

/// Whether the control puts a foot somewhere. A heel rises above toes that stay where they are.
bool MovesAFoot(SideControl control) { return control >= SideControl::kLegFree && control != SideControl::kFootHeel; }

}  // namespace

Controls SequenceAt(std::span<const Turn> turns, double beat) {
  assert(!turns.empty());
  // The turn that the beat belongs to, and the two turns of the blend that it lies in.
  const auto after = std::ranges::upper_bound(turns.begin() + 1, turns.end(), beat, {}, &Turn::start_beat);
  const Turn& now = *(after - 1);
  const Controls dancing = TurnAt(now, beat);
  const bool is_leaving = after != turns.end() && beat > after->start_beat - kBlendBeatsBefore;
  const bool is_arriving = &now != &turns.front() && beat < now.start_beat + kBlendBeatsAfter;
  if (!is_leaving && !is_arriving) return dancing;

  const Turn& next = is_leaving ? *after : now;
  const double since = beat - (next.start_beat - kBlendBeatsBefore);
  const double share = Smootherstep(since / (kBlendBeatsBefore + kBlendBeatsAfter));
  Controls mixed = Mix(TurnAt(*(&next - 1), beat), TurnAt(next, beat), share);
  for (Side side : {Side::kLeft, Side::kRight}) {
    for (std::size_t i = 0; i < kSideControlCount; ++i) {
      const auto control = static_cast<SideControl>(i);
      if (MovesAFoot(control)) mixed.Of(side, control) = dancing.Of(side, control);
    }
  }
  return mixed;
}

}  // namespace etude
