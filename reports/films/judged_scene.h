#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/recordings/task_extras.h"
#include "engine/base/result.h"
#include "engine/motion/body.h"
#include "engine/recognition/sight.h"
#include "engine/recognition/taught_move.h"
#include "io/drawing/film.h"
#include "reports/films/cast.h"
#include "reports/films/session_parts.h"

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

/// The film of a session before the sensor: the skeleton as the sensor saw it over the body as it moved; the angles of
/// the key poses asked for, each pose ticked off when it is reached; the evidence; and a timeline of truth, of the
/// verdicts of every method, and of false alarms.
class JudgedScene : public Scene {
 public:
  /// Shows at most `longest` frames, from just before the performance that precedes the first misjudged one.
  JudgedScene(JudgedSessionFacts facts, std::string heading, int longest);

  int Frames() const override { return last_ - first_; }
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  using Performance = JudgedSessionFacts::Performance;

  /// Gives the performance asked for, or the last that was; before the first, the first.
  std::size_t CurrentAt(int frame) const;
  /// Gives "right" or "wrong" once it is known, else "".
  std::string CalledAt(std::size_t judge, std::size_t performance, int frame) const;
  bool IsMisjudged(std::size_t performance) const;
  void DrawSkeleton(Canvas& canvas, int now) const;
  void DrawAngles(Canvas& canvas, int now) const;
  void DrawTimeline(Canvas& canvas, int now) const;

  JudgedSessionFacts facts_;
  std::string heading_;
  int first_ = 0, last_ = 0;  ///< [first_, last_) of the session
};

}  // namespace etude
