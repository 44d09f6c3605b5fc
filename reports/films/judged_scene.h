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
#include "reports/films/session_parts.h"
#include "reports/films/shown_cell.h"

namespace etude {

/// A recorded session of the detection task, and the verdicts of one or more methods. Frame numbers count from the
/// session's first frame.
struct JudgedSessionFacts {
  struct Performance {
    std::string move, truth, fault;  ///< truth: right, grey, wrong; fault: "none", or names
    int begin_frame = 0, end_frame = 0;
    std::vector<TaughtPose> poses;  ///< the expected key poses; empty if the recording does not define the move
    /// For each key pose, the frame at which the performer had reached this pose and all earlier poses; nullopt if that
    /// never happened.
    std::vector<std::optional<int>> reached;
  };
  struct Judge {
    std::string method;
    /// For each performance, the frame at which the method gave the verdict "right"; nullopt if the method did not give
    /// this verdict.
    std::vector<std::optional<int>> called_right;
    std::vector<DetectionExtras::Alarm> alarms;  ///< the method's false alarms
  };

  std::vector<Performance> performances;  ///< performances in order of time
  std::vector<Judge> judges;  ///< the methods; the film shows the sensed skeleton and evidence of the first method
  BodyMotion truth;
  SeenStream seen;
  std::vector<double> evidence;     ///< the first method's score, one per frame; empty if the first method has no score
  std::optional<double> threshold;  ///< the evidence that the verdict "right" requires; nullopt if not recorded

  int Frames() const { return static_cast<int>(seen.filtered.frames.size()); }
};

/// Reads the recording that the detection task keeps of a cell, and the recordings of other methods in the same world.
/// Fails if the task kept no recording of the cell.
Result<JudgedSessionFacts> ReadJudgedSession(const RunData& run, const ShownCell& cell);

/// The film of a session in which methods judge performances. It shows the sensed skeleton over the true body; the
/// angles of the expected key poses, with a check mark when a pose is reached; the evidence; and a timeline with the
/// truth, every method's verdicts, and the false alarms.
class JudgedScene : public Scene {
 public:
  /// Shows at most `longest` frames. The film begins just before the performance that precedes the first misjudged
  /// performance.
  JudgedScene(JudgedSessionFacts facts, std::string heading, int longest);

  int Frames() const override { return last_ - first_; }
  int PosterFrame() const override;
  std::string Words() const override;
  Canvas Draw(int frame) override;

 private:
  using Performance = JudgedSessionFacts::Performance;

  /// Returns the index of the performance that is expected at a frame. If no performance is expected, returns the last
  /// performance before the frame, or, before all performances, the first.
  std::size_t CurrentAt(int frame) const;
  /// Returns the verdict of a judge on a performance, "right" or "wrong"; "" if the verdict comes after `frame`.
  std::string CalledAt(std::size_t judge, std::size_t performance, int frame) const;
  bool IsMisjudged(std::size_t performance) const;
  void DrawSkeleton(Canvas& canvas, int now) const;
  void DrawAngles(Canvas& canvas, int now) const;
  void DrawTimeline(Canvas& canvas, int now) const;

  JudgedSessionFacts facts_;
  std::string heading_;
  int first_ = 0, last_ = 0;  ///< the film shows the session's frames [first_, last_)
};

}  // namespace etude
