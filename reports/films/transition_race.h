#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "io/drawing/film.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// The coach's motion under one method before and after a request. Times are frames after the request.
struct TransitionPath {
  std::string method;
  std::size_t method_index = 0;  ///< index of the method in the scenario, which selects the colour
  TransitionFacts facts;
  BodyMotion motion;
  std::vector<double> jumps_cm;  ///< for each frame, the largest second difference of any joint's position
  int request = 0;  ///< index into `motion` of the frame of the request; the index may lie outside `motion`

  /// Returns the index of the frame `time` frames after the request. Times before or after the recording give the
  /// recording's first or last frame.
  int FrameAt(int time) const;
  bool IsRecordedAt(int time) const;
  /// Returns the time of a frame of the motion, in frames after the request.
  int TimeOf(int frame) const { return frame - request; }
  /// Returns the number of transition points before `time`.
  std::size_t PointsBefore(int time) const;
  int FirstPoint() const { return TimeOf(facts.transition_frames.front()); }
  int LastPoint() const { return TimeOf(facts.transition_frames.back()); }
};

/// One request, and the transitions that one to four methods made for this request.
struct TransitionRace {
  std::string world;    ///< name of the world: "trial 30"
  std::string request;  ///< the playing clip and the wanted clip: "clap → side kick"
  std::string choice;   ///< a sentence that says why this world and these methods were chosen
  std::vector<TransitionPath> paths;
};
constexpr std::size_t kMaxTransitionPaths = 4;

/// Returns the transitions of these methods in a world, in the order of `methods`, at most kMaxTransitionPaths. A
/// method is left out if it made no transition that can be shown.
TransitionRace RaceIn(const RecordedRequest& world, const ScenarioSummary& scenario,
                      const std::vector<std::string>& methods);

/// Finds the first world in which the largest number of methods have recordings. Takes at most kMaxTransitionPaths
/// methods, in the scenario's order. Fails with the reason if no recorded transition can be shown.
Result<TransitionRace> FindTransitionRace(const RunData& run, const ScenarioSummary& scenario);

/// Maps the film's frames to times after the request; the map is the same for every method. The film runs from one
/// second before the request until after the last transition; then it repeats the transitions in slow motion.
class TransitionClock {
 public:
  static constexpr int kSlowness = 4;

  explicit TransitionClock(const TransitionRace& race);

  int First() const { return first_; }
  int Last() const { return last_; }
  int Frames() const { return Run() + kRest + kSlowness * (slow_last_ - slow_first_ + 1) + kRest; }
  int TimeAt(int frame) const;
  bool IsSlow(int frame) const { return frame >= Run() + kRest; }
  /// Returns the first frame of the film that shows `time`.
  int FrameOf(int time) const;

 private:
  static constexpr int kRest = kFilmRate / 2;

  int Run() const { return last_ - first_ + 1; }

  int first_, last_;
  int slow_first_, slow_last_;
};

}  // namespace etude
