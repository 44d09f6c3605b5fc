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

/// The true move of a performance, and the move it was classified as; "" = none.
struct Classified {
  std::string truth, taken_for, person;
};
/// Returns the share of performances that were classified correctly; nothing without any.
std::optional<double> Accuracy(std::span<const Classified> verdicts);

/// The result of recognising each person with moves taught by all others.
struct LeaveOneOut {
  std::vector<std::string> people;         ///< sorted
  std::vector<Classified> verdicts;        ///< of right performances with a beginning and an end
  /// The same performances, classified by the nearest whole performance of anybody else: a yardstick.
  std::vector<Classified> nearest;
  std::vector<Moment> points, detections;  ///< of recordings with action points, on one time axis
  /// Performances of moves that nobody else did right; `verdicts` holds them as not recognised.
  int untaught_performances = 0;
};

/// Leaves one person out at a time: teaches all moves by the others' right performances (their wrong ones are
/// counter-examples), then classifies that person's. Fails for parts without a person (naming their line of `file`),
/// and for fewer than two people.
Result<LeaveOneOut> LeaveOnePersonOut(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                                      const std::string& file, const WatchOptions& options);

/// Returns the distance of two performances, centimetres RMS per joint with the trunk scaled to 50 cm, by dynamic time
/// warping of both as a whole (Sakoe and Chiba 1978, symmetric): the usual yardstick for such data sets. Nullopt if one
/// shows no body.
std::optional<double> WarpedDistanceCm(const SkeletonStream& a, const SkeletonStream& b);

/// Scores how well recognised moves agree with labels, over several recordings.
class LabelScores {
 public:
  /// All arguments must outlive this; `recogniser` was taught `moves`.
  LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch);

  /// Adds a recording with its parts and the moves spotted in it. The recogniser is asked for each performance from its
  /// beginning to half a second after its end; the performance counts as called right if its evidence reaches the
  /// threshold. Labels of moves that were not taught are only counted.
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

/// Returns one line of JSON: {"stream": "take", "frame": 97, "time_s": 3.2333, "move": "open", "evidence": 0.61},
/// without the stream if its name is "".
std::string SpottingLine(const Spotting& spotting, const std::string& move, double rate_hz, const std::string& stream);

/// Returns {"scores": {…}} for programs (docs/schemas/facts.schema.json).
Json FactsOf(const LabelScores& scores);
Json FactsOf(const LeaveOneOut& out);

}  // namespace etude
