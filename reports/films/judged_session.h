#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/recognition/sight.h"
#include "engine/recognition/taught_move.h"
#include "reports/films/cast.h"

namespace etude {

/// A recorded session of the detection task, and how one or more methods judged it. Frames count from the session's
/// first.
struct JudgedSessionFacts {
  struct Performance {
    std::string move, truth, fault;  ///< truth: right, grey, wrong; fault: "none", or names
    int begin_frame = 0, end_frame = 0;
    std::vector<TaughtPose> poses;            ///< none: of the move no key pose is known
    std::vector<std::optional<int>> reached;  ///< per pose: when it and all before it were first seen, in the window
  };
  struct Judge {
    std::string method;
    std::vector<std::optional<int>> called_right;  ///< per performance: the frame; nothing: called wrong
    std::vector<DetectionExtras::Alarm> alarms;    ///< false ones
  };

  std::vector<Performance> performances;  ///< in order of time
  std::vector<Judge> judges;              ///< the first is the one whose view and evidence are shown
  BodyMotion truth;
  SeenStream seen;
  std::vector<double> evidence;     ///< per frame; may be none at all
  std::optional<double> threshold;  ///< of judging

  int Frames() const { return static_cast<int>(seen.filtered.frames.size()); }
};

/// Reads what the detection task keeps of a cell, and of the cells of other methods in the same world. Fails when it is
/// not that.
Result<JudgedSessionFacts> ReadJudgedSession(const RunData& run, const CastCell& cell);

}  // namespace etude
