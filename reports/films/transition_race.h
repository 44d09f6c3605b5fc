#pragma once

#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// What one method did with a request, frame by frame from the request on.
struct TransitionPath {
  std::string method;
  std::size_t method_index = 0;  ///< in the scenario: its colour
  TransitionFacts facts;
  BodyMotion motion;
  std::vector<double> jumps_cm;  ///< largest second difference of any joint, one per frame
  int request = 0;               ///< index into `motion` of the frame shown at the request; may lie outside of it

  /// The frame shown so many frames after the request; before the recording the first, after it the last.
  int FrameAt(int time) const;
  bool IsRecordedAt(int time) const;
  /// The same, of a frame of the motion, as time after the request.
  int TimeOf(int frame) const { return frame - request; }
  /// How many transition points lie before the frame shown at that time.
  std::size_t PointsBefore(int time) const;
  int FirstPoint() const { return TimeOf(facts.transition_frames.front()); }
  int LastPoint() const { return TimeOf(facts.transition_frames.back()); }
};

/// One request under two to four methods.
struct TransitionRace {
  std::string world;    ///< "trial 30"
  std::string request;  ///< "clap → side kick"
  std::string choice;   ///< why this world and these methods, in words
  std::vector<TransitionPath> paths;
};
constexpr std::size_t kMostTransitionPaths = 4;

/// The first world that kept recordings of the most methods (at most kMostTransitionPaths, the scenario's first): never
/// the prettiest one. Fails, saying why, when no world kept those of two.
Result<TransitionRace> FindTransitionRace(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
