#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/detection.h"
#include "bench/streams/leave_one_out.h"

namespace etude {

/// How what was recognised agrees with labels, gathered recording by recording.
class LabelScores {
 public:
  /// All must outlive this; `recogniser` was taught `moves`.
  LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch);

  /// `parts`: of this recording. A performance counts as called right when its evidence, asked for from its beginning
  /// to half a second after its end, reaches the threshold. Labels of moves that were not taught are counted only.
  void Add(const NamedStream& stream, std::span<const LabelledPart> parts, std::span<const Spotting> spottings);

  const std::vector<JudgedEvent>& Performances() const { return performances_; }
  const std::vector<Moment>& Points() const { return points_; }
  std::optional<double> PointFScore() const;
  double FalseAlarmsAMinute() const;
  int Untaught() const { return untaught_; }

 private:
  std::span<const TaughtMove> moves_;
  const Recogniser& recogniser_;
  const WatchOptions& watch_;
  std::vector<JudgedEvent> performances_;
  std::vector<Moment> points_, detections_;
  std::size_t alarms_ = 0;
  int untaught_ = 0;
  double seconds_ = 0, clock_s_ = 0;
};

/// One line of JSON: {"stream": "take", "frame": 97, "time_s": 3.2333, "move": "open", "evidence": 0.61}; no stream
/// when "" is its name.
std::string SpottingLine(const Spotting& spotting, const std::string& move, double rate_hz, const std::string& stream);

/// {"scores": {…}}
std::string ScoresLine(const LabelScores& scores);
std::string ScoresLine(const LeaveOneOut& out);

}  // namespace etude
