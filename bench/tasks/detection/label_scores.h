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

/// A classified performance: its true move, the move that the recogniser found ("" = none), and its person.
struct Classified {
  std::string truth, taken_for, person;
};
/// Returns the share of performances that were classified correctly; nothing without performances.
std::optional<double> Accuracy(std::span<const Classified> verdicts);

/// The result of leave-one-person-out: each person is recognised with moves taught by all others.
struct LeaveOneOut {
  std::vector<std::string> people;   ///< names of the people, sorted
  std::vector<Classified> verdicts;  ///< the right performances whose labels give a beginning and an end
  /// The performances of `verdicts`, classified by the nearest whole performance of any other person. This is a
  /// baseline for comparison.
  std::vector<Classified> nearest;
  std::vector<Moment> points, detections;  ///< times of action points and of detections, in recordings with action
                                           ///< points, on one time axis
  /// The number of performances whose move nobody else performed right. `verdicts` contains them as not recognised.
  int untaught_performances = 0;
};

/// Leaves one person out at a time: teaches all moves by the other people's right performances (their wrong ones are
/// counter-examples), then classifies the performances of the person left out. Fails if a part has no person (naming
/// the part's line in `file`), or if there are fewer than two people.
Result<LeaveOneOut> LeaveOnePersonOut(const std::vector<NamedStream>& streams, const std::vector<LabelledPart>& parts,
                                      const std::string& file, const WatchOptions& options);

/// Returns the distance of two performances, centimetres. Dynamic time warping aligns them as a whole (Sakoe and
/// Chiba 1978, symmetric), and all trunks are scaled to 50 cm. The distance is the root mean square of the joints'
/// distances along the alignment. It is the usual reference method for data sets of labelled performances. Returns
/// nullopt if one of the performances shows no body.
std::optional<double> WarpedDistanceCm(const SkeletonStream& a, const SkeletonStream& b);

/// Scores how well recognised moves agree with labels, over several recordings.
class LabelScores {
 public:
  /// All arguments must outlive this object. `recogniser` must have been taught `moves`.
  LabelScores(std::span<const TaughtMove> moves, const Recogniser& recogniser, const WatchOptions& watch);

  /// Adds a recording with its labelled parts and the moves spotted in it. The recogniser judges each performance from
  /// the performance's beginning to half a second after its end. The performance is called right if its evidence
  /// reaches the threshold. Labels of moves that were not taught are only counted.
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

/// Returns one line of JSON: {"stream": "take", "frame": 97, "time_s": 3.2333, "move": "open", "evidence": 0.61}. The
/// key "stream" is left out if `stream` is "".
std::string SpottingLine(const Spotting& spotting, const std::string& move, double rate_hz, const std::string& stream);

/// Returns the scores as {"scores": {…}}, for programs (docs/schemas/facts.schema.json).
Json FactsOf(const LabelScores& scores);
Json FactsOf(const LeaveOneOut& out);

}  // namespace etude
