#pragma once

#include <optional>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "reports/films/cast.h"

namespace etude {

/// A recorded session of a coach, as a film needs it. Frames count from the session's first.
struct CoachedSessionFacts {
  struct Mode {
    std::string mode;
    int begin_frame = 0;
  };
  struct Performance {
    std::string move, truth, called;  ///< truth: right, grey, wrong; called: right, wrong, unjudged
    int begin_frame = 0, end_frame = 0;
  };
  struct Words {
    int begin_frame = 0;
    std::string say, hint;
    std::optional<BodyPose> picture;
  };
  struct Decision {
    int frame = 0;
    std::string event, why;
  };

  std::string song;
  std::vector<Mode> modes;
  std::vector<Performance> performances;
  std::vector<Words> words;
  std::vector<Decision> decisions;
  std::vector<int> corrections, transitions;
  std::vector<double> beats_s;        ///< when the music's beats sounded, ascending
  BodyMotion coach, learner, sensed;  ///< of one length

  int Frames() const { return static_cast<int>(coach.poses.size()); }
};

/// Reads what the coach task keeps of a cell. Fails when it is not that.
Result<CoachedSessionFacts> ReadCoachedSession(const CastCell& cell);

/// Of a scenario's recorded sessions the worst: the most needless and missed corrections a minute. None where nothing
/// was recorded.
std::optional<CastCell> ChooseWorstSession(const RunData& run, const ScenarioSummary& scenario);

}  // namespace etude
