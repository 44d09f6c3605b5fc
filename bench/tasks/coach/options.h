#pragma once

#include <string>
#include <vector>

#include "bench/tasks/detection/options.h"
#include "bench/tasks/transition/options.h"
#include "engine/coaching/coach.h"
#include "engine/coaching/policy.h"
#include "sim/music/music.h"
#include "sim/performer/learner.h"

namespace etude {

/// The point at which coaches are compared: each uses the threshold on evidence at which this many right performances a
/// minute are taken for mistakes, by other people under the same condition.
struct CoachOperatingPoint {
  double needless_per_min = 0.2;
  int sessions = 24;  ///< number of sessions, each of another person
};

/// One condition of a coach scenario: who learns what, how well the sensor sees it, and how well the music keeps time.
///
///     song: groove       # what is danced
///     session_s: 180     # how long the coach may take; the song begins anew when it is over
///     people: adult      # who learns
///     learning: power    # by which law
///     noise: 1           # times every error of the sensor
struct CoachCondition {
  std::string song = "groove";
  double session_s = 180;
  LearnerOptions learner;
  std::optional<CoachOperatingPoint> operating_point;  ///< sets the thresholds of methods that say none
  MusicClockOptions music;
  DetectionOptions sight;  ///< the person and the sensor; its session's script is not used
};

/// The part of the loop that an outside program takes.
enum class Seat { kNone, kRecogniser, kPolicy, kLearner };
/// "recogniser", "policy", "learner".
const std::vector<std::string>& SeatNames();

/// One coach.
///
///     - {name: a, recogniser: key-pose, policy: at-first-mistake, choice: fuzzy-bridge, join: cut}
///     - {name: control, recogniser: key-pose, policy: yoked, partner: at-first-mistake}
struct CoachMethod {
  std::string name;
  DetectionMethod sight;
  Coach::PolicyChoice policy{&AllPolicies().front(), {}};
  const Policy* partner = &AllPolicies().front();  ///< of the session from which a yoked method takes its correction
                                                   ///< times
  bool knows_truth = false;                        ///< `oracle: [judgement]`
  TransitionMethod transition;
  CoachOptions coach;
  Seat seat = Seat::kNone;
};

const FieldTable<CoachCondition>& CoachConditionFields();
const FieldTable<CoachMethod>& CoachMethodFields();

}  // namespace etude
