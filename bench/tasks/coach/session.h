#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/coach.h"
#include "bench/tasks/coach/world.h"
#include "engine/coaching/coach.h"
#include "engine/motion/body.h"
#include "engine/recognition/filters.h"
#include "engine/recognition/recogniser.h"

namespace etude {

/// A performance as its player knows it.
struct PlayedPerformance {
  PerformanceTruth truth = PerformanceTruth::kRight;
  std::string faults = "none";  ///< "amplitude+late"
};

/// The dancer before the coach.
class Player {
 public:
  virtual ~Player() = default;

  /// The body's next pose, now that the coach shows this: SkeletonSensor::kAhead frames ahead of what is shown, for
  /// nobody acts at once on what is seen (0.23 s; a simple reaction to something seen takes 0.2 to 0.25 s).
  virtual BodyPose Next(const CoachOutput& shown) = 0;
  /// The latest performance of this repetition of the dance; none when it was not begun.
  virtual std::optional<PlayedPerformance> PerformanceOf(int repetition) const = 0;
  /// True when the player's patience has run out.
  virtual bool HasGivenUp() const = 0;
  /// The test without a coach, so many performances' time after the session: for every move of the dance the chance to
  /// dance it without a fault; of a player who cannot say, 1 or 0, and no entry for what is neither.
  virtual std::vector<double> TakeTest(int performances_later) = 0;
};

/// A performance that was asked for, as the player danced it and as the coach judged it.
struct LoggedPerformance {
  int repetition = 0;  ///< of the dance
  int move = 0;
  CoachedPerformance judged;
  std::string faults;
};

/// A transition of the coach's: the frames of the session that are the last before each of its transition points.
struct LoggedTransition {
  std::vector<int> seams;
  bool is_bridged = false;  ///< bridge frames carry it, directly or through in-betweens made of such
};

/// The words on the screen from a frame on.
struct LoggedWords {
  int begin_frame = 0;
  std::string say, hint;
  std::optional<BodyPose> picture;  ///< the key pose that the hint is about
};

/// The log of a session.
struct SessionLog {
  std::vector<CoachMode> modes;  ///< per frame
  std::vector<LoggedPerformance> performances;
  std::vector<GivenCorrection> corrections;
  std::vector<CoachRecord> records;  ///< frames count from the session's first
  std::vector<LoggedTransition> transitions;
  std::vector<LoggedWords> words;     ///< whenever they change
  std::vector<double> beat_errors_s;  ///< of the frames danced to music
  std::vector<double> beats_s;        ///< when the music's beats sounded, seconds since the session began
  BodyMotion coach;                   ///< as shown
  BodyMotion learner;                 ///< as danced
  SkeletonStream sensed;              ///< as the coach sees it, before its filter
  std::optional<int> given_up_at;     ///< frame
  std::vector<double> test;           ///< afterwards, without a coach (Player::TakeTest)

  int Frames() const { return static_cast<int>(modes.size()); }
};

/// The parts of a session; all must outlive it.
struct SessionParts {
  const Coach& coach;
  const Recogniser& recogniser;
  FilterOptions filter;
  bool sees_truth = false;     ///< the coach sees the learner as danced, not as sensed
  CaptureMethod capture = {};  ///< before cameras: how they make skeletons, causally
};

/// Decides from frame to frame, in place of the coach's own policy, when to correct.
class MomentSource {
 public:
  virtual ~MomentSource() = default;
  virtual bool Now(int frame, const CoachOutput& before) = 0;
};

/// Runs one session: the player sees the coach, the sensor sees the player, the coach sees what the sensor reports.
/// `moments`: null = none. Fails, saying why, when cameras cannot be set up.
Result<SessionLog> RunSession(const SessionParts& parts, const CoachWorld& world, Player& player,
                              MomentSource* moments);

}  // namespace etude
