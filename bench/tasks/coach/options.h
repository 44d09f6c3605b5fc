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

/// The operating point at which coaches are compared. Each coach uses the threshold on evidence at which
/// `needless_per_min` right performances per minute are taken for mistakes, measured on other people under the same
/// condition.
struct CoachOperatingPoint {
  double needless_per_min = 0.2;
  int sessions = 24;  ///< number of sessions, each with a different person
};

/// One condition of a coach scenario: the learner, the song, the quality of the sensor and the steadiness of the music.
///
///     song: groove       # the song that is danced
///     session_s: 180     # length of the session, seconds; the song is repeated
///     people: adult      # the kind of learner
///     learning: power    # the law of learning
///     noise: 1           # factor of every error of the sensor
struct CoachCondition {
  std::string song = "groove";
  double session_s = 180;
  LearnerOptions learner;
  std::optional<CoachOperatingPoint> operating_point;  ///< sets the thresholds of methods that do not set their own
  MusicClockOptions music;
  DetectionOptions sight;  ///< the person and the sensor; `sight.session` is not used
};

/// The part of the loop (the seat) that an outside program replaces.
enum class Seat { kNone, kRecogniser, kPolicy, kLearner };
/// Returns "recogniser", "policy", "learner".
const std::vector<std::string>& SeatNames();

/// One coach that a scenario compares.
///
///     - {name: a, recogniser: key-pose, policy: at-first-mistake, choice: fuzzy-bridge, join: cut}
///     - {name: control, recogniser: key-pose, policy: yoked, partner: at-first-mistake}
struct CoachMethod {
  std::string name;
  DetectionMethod sight;
  Coach::PolicyChoice policy{&AllPolicies().front(), {}};
  /// A yoked method corrects at the times at which a session with this policy corrects.
  const Policy* partner = &AllPolicies().front();
  bool knows_truth = false;  ///< true: the coach knows the truth about performances (`oracle: [judgement]`)
  TransitionMethod transition;
  CoachOptions coach;
  Seat seat = Seat::kNone;
};

const FieldTable<CoachCondition>& CoachConditionFields();
const FieldTable<CoachMethod>& CoachMethodFields();

}  // namespace etude
