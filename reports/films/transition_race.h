#pragma once

#include <string>
#include <vector>

#include "bench/results/run_data.h"
#include "reports/transitions/recorded_requests.h"

namespace etude {

/// What one method did with a request, frame by frame from the request on.
struct SwitchPath {
  std::string method;
  SwitchFacts facts;
  BodyMotion motion;
  std::vector<double> jumps_cm;  ///< largest second difference of any joint, one per frame
  int request = 0;               ///< index into `motion` of the frame shown at the request; may lie outside of it

  /// The frame shown so many frames after the request; before the recording the first, after it the last.
  int FrameAt(int time) const;
  bool IsRecordedAt(int time) const;
  /// The same, of a frame of the motion, as time after the request.
  int TimeOf(int frame) const { return frame - request; }
  /// How many seams lie before the frame shown at that time.
  std::size_t SeamsBefore(int time) const;
  int FirstSeam() const { return TimeOf(facts.seam_frames.front()); }
  int LastSeam() const { return TimeOf(facts.seam_frames.back()); }
};

/// One request under two to four methods.
struct SwitchRace {
  std::string world;    ///< "trial 30"
  std::string request;  ///< "clap → side kick"
  std::string choice;   ///< why this world and these methods, in words
  std::vector<SwitchPath> paths;
};
constexpr std::size_t kMostSwitchPaths = 4;

/// The first world that kept recordings of the most methods (at most kMostSwitchPaths, the scenario's first): never the
/// prettiest one. Fails, saying why, when no world kept those of two.
Result<SwitchRace> FindSwitchRace(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
