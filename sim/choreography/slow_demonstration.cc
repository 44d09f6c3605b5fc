#include "sim/choreography/slow_demonstration.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace etude {
namespace {

constexpr double kHoldBeats = 1;

/// The timing of a demonstration: a map from beats of the demonstration to beats of the move, with a stop at each key
/// pose.
class Pauses {
 public:
  /// `stops` must ascend strictly within (0, beats).
  Pauses(std::vector<double> stops, double beats) : stops_(std::move(stops)), beats_(beats) {
    double before = 0;
    for (std::size_t i = 0; i <= stops_.size(); ++i) {
      const double next = i < stops_.size() ? stops_[i] : beats;
      // Two ramps must fit between neighbouring stops. The mean speed in a ramp is ½, so a ramp that lasts r beats
      // covers r / 2 beats of the move.
      ramp_ = std::min(ramp_, next - before);
      before = next;
    }
  }

  /// Returns the number of beats by which every stop lengthens the demonstration: the hold, and the time lost in two
  /// ramps.
  double PerStop() const { return kHoldBeats + ramp_; }
  double Beats() const { return beats_ + PerStop() * static_cast<double>(stops_.size()); }
  /// Returns the beat at which the hold of a stop begins.
  double HoldStart(std::size_t stop) const {
    return stops_[stop] + PerStop() * static_cast<double>(stop) + 0.5 * ramp_;
  }

  /// Returns the beat of the move at a beat of the demonstration. During a hold, the beat of the move is constant.
  double MoveBeat(double beat) const {
    for (std::size_t i = stops_.size(); i-- > 0;) {
      const double since = beat - HoldStart(i);
      if (since >= kHoldBeats) return stops_[i] + Gathering(since - kHoldBeats);
      if (since >= 0) return stops_[i];
      if (since >= -ramp_) return stops_[i] - Gathering(-since);
    }
    return beat;
  }

 private:
  /// Returns the distance covered in `time` by a motion that starts at rest: within the time `ramp_`, the speed rises
  /// to 1 along a smoothstep.
  double Gathering(double time) const {
    if (time >= ramp_) return time - 0.5 * ramp_;
    const double t = time / ramp_;
    return ramp_ * t * t * t * (1 - 0.5 * t);
  }

  std::vector<double> stops_;
  double beats_;
  double ramp_ = 0.5;
};

}  // namespace

Result<Move> SlowDemonstration(const Move& move) {
  // Collect the beats of the key poses, where the demonstration stops.
  std::vector<double> stops;
  for (const KeyPose& key_pose : move.key_poses) stops.push_back(key_pose.beat);
  std::ranges::sort(stops);
  if (stops.empty()) return Fail({}, "'{}' has no key poses that could be demonstrated", move.name);
  if (stops.front() <= 0) return Fail({}, "'{}' has a key pose at beat 0; allowed: key poses after beat 0", move.name);
  stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
  const Pauses pauses(stops, move.beats);

  // Set the demonstration's name, tempo and key poses.
  Move demonstration = move;
  demonstration.name = std::string(kSlowDemonstrationPrefix) + move.name;
  demonstration.tempo_bpm = 0.5 * move.tempo_bpm;
  demonstration.slowest_bpm = demonstration.fastest_bpm = demonstration.tempo_bpm;
  demonstration.beats = pauses.Beats();
  for (KeyPose& key_pose : demonstration.key_poses) {
    const auto stop = std::ranges::find(stops, key_pose.beat) - stops.begin();
    key_pose.beat = pauses.HoldStart(static_cast<std::size_t>(stop));
  }

  // Sample the move densely: a hold becomes a run of equal values, between which curves are exactly constant.
  constexpr double kPerBeat = 16;
  const auto steps = static_cast<int>(std::ceil(kPerBeat * demonstration.beats));
  std::vector<Controls> bodies;
  for (int i = 0; i < steps; ++i) {
    bodies.push_back(move.curves.At(pauses.MoveBeat(demonstration.beats * i / steps)));
  }
  demonstration.poses.clear();
  demonstration.curves = MoveCurves::Through(bodies, demonstration.beats);
  demonstration.motion = MotionOf(demonstration);
  return demonstration;
}

}  // namespace etude
