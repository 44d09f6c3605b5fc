#include "engine/coaching/coach.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/coaching/stepping.h"

namespace etude {
namespace {

/// The hands count as together if the distance of their tips is below the first value, and as apart if it is above the
/// second, metres (ours). A Kinect's hands have errors of about 5 cm while moving, and palms are thick.
constexpr double kTogether = 0.15, kApart = 0.4;
constexpr int kTogetherFrames = 2, kSwingFrames = 15;

/// The body counts as moving if the mean distance of the tracked joints from their rest positions exceeds this limit
/// (ours). A resting body moves by millimetres, while an inferred limb can jump by decimetres, so only the mean over
/// tracked joints counts.
constexpr double kMovingMetres = 0.025;
/// The smoothing factor per frame of the rest positions; it corresponds to a time constant of half a second.
constexpr double kFollowing = 1.0 / 15;

}  // namespace

bool SeeClap(const SensedFrame& frame, ClapState& state) {
  using enum Role;
  const auto is_seen = [&](Role role) { return frame[role].state == TrackingState::kTracked; };
  if (!frame.body_seen || !is_seen(kLeftHand) || !is_seen(kRightHand)) {
    state = {};
    return false;
  }
  const glm::dvec3 left = frame[kLeftHand].position, right = frame[kRightHand].position;
  const double gap = glm::distance(left, right);
  if (gap > kApart) {
    state = {.since_apart = 0, .together = 0};
    return false;
  }
  if (state.since_apart < ClapState::kLongAgo) ++state.since_apart;
  const double hips = frame[kHipCentre].position.y;
  state.together = gap < kTogether && left.y > hips && right.y > hips ? state.together + 1 : 0;
  return state.together == kTogetherFrames && state.since_apart <= kSwingFrames;
}

bool SeeMotion(const SensedFrame& frame, StillnessState& state) {
  ++state.frames;
  if (!frame.body_seen) {
    state.started = false;
    return false;
  }
  double sum = 0;
  int count = 0;
  for (std::size_t i = 0; i < kRoleCount; ++i) {
    const SensedJoint& joint = frame.joints[i];
    if (!state.started) state.rest[i] = joint.position;
    if (joint.state != TrackingState::kTracked) continue;
    const glm::dvec3 off = joint.position - state.rest[i];
    sum += glm::length(off);
    ++count;
    state.rest[i] += kFollowing * off;
  }
  state.started = true;
  ++state.seen;
  const bool moves = count > 0 && sum > kMovingMetres * count;
  if (moves) ++state.moving;
  return moves;
}

void ResetCounts(StillnessState& state) { state.seen = state.moving = state.frames = 0; }

std::string_view EventName(CoachEvent event) {
  constexpr std::array<std::string_view, 15> kNames = {"woken",    "song begins", "right",     "wrong",    "unjudged",
                                                       "corrects", "shows",       "returns",   "goes on",  "praises",
                                                       "tag",      "transition",  "song ends", "attracts", "dozes"};
  return kNames[static_cast<std::size_t>(event)];
}

std::string_view MistakeName(Mistake mistake) {
  constexpr std::array<std::string_view, 4> kNames = {"none", "not reached", "stood still", "wrong side"};
  return kNames[static_cast<std::size_t>(mistake)];
}

std::string_view ModeName(CoachMode mode) {
  constexpr std::array<std::string_view, 8> kNames = {"standby", "attract", "doze",        "wake",
                                                      "dance",   "correct", "demonstrate", "praise"};
  return kNames[static_cast<std::size_t>(mode)];
}

std::string_view HintText(PlayerHint hint) {
  constexpr std::array<std::string_view, 4> kTexts = {"", "come into view", "come nearer", "step back"};
  return kTexts[static_cast<std::size_t>(hint)];
}

Coach::Coach(const DanceTransitions& transitions, const CoachOptions& options, PolicyChoice policy)
    : transitions_(transitions), options_(options), policy_(std::move(policy)) {}

CoachState Coach::Begin() const {
  CoachState state;
  state.playback.path = transitions_.Alone(transitions_.library().ClipOfAct("standby"));
  state.moves.resize(dance().moves.size());
  return state;
}

CoachState Coach::BeginDancing() const {
  CoachState state = Begin();
  state.mode = CoachMode::kDance;
  state.playback = {};
  return state;
}

void Coach::PlanAhead() const {
  const DanceLibrary& library = transitions_.library();
  const auto last_of = [&](int clip) { return static_cast<int>(library.library().motions[clip].poses.size()) - 1; };
  const double lag = options_.reaction_s * kJudgedRateHz;
  const int repetitions = static_cast<int>(dance().repetitions.size());
  // Plan the transitions from every window's end into every corrective act.
  for (const char* act : {"head_shake", "wave", "puzzled"}) {
    const int whole = library.ClipOfAct(act);
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      const double closes = static_cast<double>(dance().repetitions[repetition].end) + lag;
      const int clip = library.ClipLeaving(library.RepetitionAt(closes));
      const int frame = static_cast<int>(std::ceil(closes - static_cast<double>(library.DanceFrameOf(clip))));
      // If the dance is sped up or slowed down, windows may close one frame earlier or later.
      for (int late = -1; late <= 1; ++late) {
        if (frame + late > last_of(clip)) continue;
        transitions_.Find(clip, frame + late, library.ClipEntering(whole));
      }
    }
    // Plan the transitions from the end of this act into every slow demonstration.
    for (int move = 0; move < static_cast<int>(dance().moves.size()); ++move) {
      transitions_.Find(whole, std::max(last_of(whole) - kBeforeEndFrames, 0),
                        library.ClipEntering(library.ClipOfSlow(move)));
    }
  }
  // Plan the transitions from each demonstration back into the dance, and from the song's end into the last acts.
  for (int repetition = 0; repetition < repetitions; ++repetition) {
    const int slow = library.ClipOfSlow(dance().repetitions[repetition].move);
    transitions_.Find(slow, std::max(last_of(slow) - kBeforeEndFrames, 0), library.ClipReturning(repetition));
  }
  const int ending = library.ClipLeaving(repetitions - 1);
  for (const char* act : {"praise", "standby"}) {
    transitions_.Find(ending, last_of(ending), library.ClipEntering(library.ClipOfAct(act)));
  }
}

CoachStep Coach::Step(CoachState state, const CoachInput& input) const {
  CoachStep step{std::move(state), {}};
  Stepping(transitions_, options_, policy_, input, step).Run();
  return step;
}

}  // namespace etude
