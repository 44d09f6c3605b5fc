#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/metrics/coach.h"
#include "bench/tasks/coach/world.h"
#include "engine/coaching/coach.h"
#include "engine/motion/body.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// The truth of a performance. Only the player of the performance knows it.
struct PlayedPerformance {
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::string faults = "none";  ///< names of the faults, e.g. "amplitude+late"
};

/// The dancer in front of the coach.
class Player {
 public:
  virtual ~Player() = default;

  /// Returns the body's next pose. `shown` is what the coach showed in the previous frame. The pose is for the time
  /// SkeletonSensor::kAhead frames (0.23 s) after the present frame, because nobody reacts at once: a simple visual
  /// reaction takes 0.2 to 0.25 s.
  virtual BodyPose Next(const CoachOutput& shown) = 0;
  /// Returns the latest performance in this repetition of the dance; nullopt if none has begun in it.
  virtual std::optional<PlayedPerformance> PerformanceOf(int repetition) const = 0;
  /// Returns true if the player's patience has run out.
  virtual bool HasGivenUp() const = 0;
  /// Tests the player without a coach, after the time that `performances_later` performances would take. Returns, for
  /// every move of the dance, the probability of dancing it without a fault. A player that does not know this
  /// probability performs each move once: the value is then 1 for a right and 0 for a wrong performance; a grey
  /// performance has no entry.
  virtual std::vector<double> TakeTest(int performances_later) = 0;
};

/// A performance that the coach asked for: how it was danced and how it was judged.
struct LoggedPerformance {
  int repetition = 0;  ///< index of the repetition in the dance
  int move = 0;
  CoachedPerformance judged;
  std::string faults;
};

/// A transition of the coach.
struct LoggedTransition {
  std::vector<int> points;
  bool is_bridged = false;  ///< true: the transition uses bridge frames, directly or with clips in between
};

/// The words on the screen. They are shown from `begin_frame` on.
struct LoggedWords {
  int begin_frame = 0;
  std::string say, hint;
  std::optional<BodyPose> picture;  ///< the key pose that the hint is about
};

/// The record of a session.
struct SessionLog {
  std::vector<CoachMode> modes;  ///< the coach's mode in each frame
  std::vector<LoggedPerformance> performances;
  std::vector<GivenCorrection> corrections;
  std::vector<CoachRecord> records;  ///< the coach's decisions; their frames count from the session's first frame
  std::vector<LoggedTransition> transitions;
  std::vector<LoggedWords> words;     ///< one entry per change of the words
  std::vector<double> beat_errors_s;  ///< timing errors in the frames danced to music
  std::vector<double> beats_s;        ///< times of the music's beats, seconds from the session's start
  BodyMotion coach;                   ///< the coach's motion as shown
  BodyMotion learner;                 ///< the learner's motion as danced
  SkeletonStream sensed;              ///< the sensor's stream, before the coach's filter
  std::optional<int> given_up_at;     ///< the frame in which the learner gave up
  std::vector<double> test;           ///< results of the test without a coach (Player::TakeTest)

  int Frames() const { return static_cast<int>(modes.size()); }
};

/// The parts of a session. All parts must outlive the session.
struct SessionParts {
  const Coach& coach;
  const Recogniser& recogniser;
  FilterOptions filter;
  bool sees_truth = false;     ///< true: the coach receives the learner's true motion, not the sensed one
  CaptureMethod capture = {};  ///< if cameras are the sensor: the causal method that makes skeletons
};

/// Replaces the coach's own policy: decides in each frame if the coach corrects.
class MomentSource {
 public:
  virtual ~MomentSource() = default;
  virtual bool Now(int frame, const CoachOutput& before) = 0;
};

/// Runs one session: the player sees the coach, the sensor observes the player, and the coach receives the sensor's
/// report. `moments` may be null. Fails, with the reason, if cameras cannot be set up.
Result<SessionLog> RunSession(const SessionParts& parts, const CoachWorld& world, Player& player,
                              MomentSource* moments);

}  // namespace etude
