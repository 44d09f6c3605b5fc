#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/metrics/detection.h"
#include "engine/teaching/teach_moves.h"
#include "engine/teaching/watch.h"
#include "io/files/json.h"

namespace etude {

/// The move of a performance, and the move it was taken for; "" for nothing.
struct Classified {
  std::string truth, taken_for, person;
};
/// Returns the share of performances taken for what they were; nothing without verdicts.
std::optional<double> Accuracy(std::span<const Classified> verdicts);

/// The outcome of recognising each person by what the others taught.
struct LeaveOneOut {
  std::vector<std::string> people;         ///< sorted
  std::vector<Classified> verdicts;        ///< of performances from a beginning to an end, done right
  std::vector<Classified> nearest;         ///< the same by the nearest of all others' whole performances: the yardstick
  std::vector<Moment> points, detections;  ///< of recordings with action points, one after another in time
  int mistaught = 0;  ///< performances of moves that nobody else did right, in `verdicts` as taken for nothing
};

/// Leaves one person out at a time: teaches all moves by the others' right performances (their wrong ones are
/// counter-examples), then classifies that person's. Refused: parts of people who are not told (of `file`, with their
/// line), fewer than two people.
Result<LeaveOneOut> LeaveOnePersonOut(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                                      const std::string& file, const WatchOptions& options);

/// Computes the distance of two performances, centimetres RMS per joint with the trunk scaled to 50 cm, by dynamic time
/// warping of the whole of both (Sakoe and Chiba 1978, symmetric): the yardstick of algorithms for such sets. Nothing
/// when one shows no body.
std::optional<double> WarpedDistanceCm(const SkeletonStream& a, const SkeletonStream& b);

/// Scores of the agreement between what was recognised and labels, gathered recording by recording.
class LabelScores {
 public:
  /// All arguments must outlive this; `recogniser` was taught `moves`.
  LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch);

  /// Adds a recording with its parts and what was spotted in it. A performance counts as called right when its
  /// evidence, asked for from its beginning to half a second after its end, reaches the threshold. Labels of moves that
  /// were not taught are counted only.
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

/// Returns one line of JSON: {"stream": "take", "frame": 97, "time_s": 3.2333, "move": "open", "evidence": 0.61}; no
/// stream when "" is its name.
std::string SpottingLine(const Spotting& spotting, const std::string& move, double rate_hz, const std::string& stream);

/// Gives {"scores": {…}} for programs (docs/schemas/facts.schema.json).
Json FactsOf(const LabelScores& scores);
Json FactsOf(const LeaveOneOut& out);

}  // namespace etude
