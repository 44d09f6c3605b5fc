#pragma once

#include "bench/metrics/detection.h"
#include "bench/streams/teach.h"
#include "bench/streams/watch.h"

namespace etude {

/// What a performance was, and what it was taken for; "" for nothing.
struct Classified {
  std::string truth, taken_for, person;
};
/// The share taken for what they were. Nothing of no verdicts.
std::optional<double> Accuracy(std::span<const Classified> verdicts);

/// What came of recognising each person by what the others taught.
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

/// The distance of two performances, centimetres RMS per joint with the trunk scaled to 50 cm, by dynamic time warping
/// of the whole of both (Sakoe and Chiba 1978, symmetric): the yardstick of algorithms for such sets. Nothing when one
/// shows no body.
std::optional<double> WarpedDistanceCm(const SkeletonStream& a, const SkeletonStream& b);

}  // namespace etude
