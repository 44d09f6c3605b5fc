#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <glm/gtc/quaternion.hpp>
#include <optional>
#include <span>
#include <vector>

#include "bench/metrics/window_error.h"

namespace etude {

/// Positions of some points over time: frames × points, metres, Y up; NaN: not seen.
struct PointTracks {
  std::size_t points = 0;
  std::vector<glm::dvec3> positions;

  std::size_t FrameCount() const { return points == 0 ? 0 : positions.size() / points; }
  std::span<const glm::dvec3> Frame(std::size_t frame) const { return {&positions[frame * points], points}; }
};

/// An answer and its truth, frame by frame: the same joints in the same order, at one rate.
struct EvaluatedPair {
  double rate_hz = 30;
  PointTracks found, truth;
  /// The point by which a pose is moved to its root (`Match` says which), one a frame; empty: one of both lacks it.
  std::vector<glm::dvec3> found_root, true_root;
  /// Global rotations of the same joints, frames × joints; each is empty if its file has none.
  std::vector<glm::dquat> found_turns, true_turns;
  /// The answer's feet: left ankle, left toes, right ankle, right toes; without points if it lacks these joints.
  PointTracks feet;
  /// The contacts with the floor that each file states, frames × the four columns of `feet` (heels for ankles); empty
  /// if it states none.
  std::vector<bool> found_contacts, true_contacts;
};

/// The mean of all added values that are not NaN.
class SeenMean {
 public:
  void Add(std::span<const double> values);
  /// Returns nothing if all values are NaN.
  std::optional<double> Value() const;

 private:
  // Values join four sums in turn, because additions to a single sum would wait for each other.
  static constexpr std::size_t kSums = 4;
  double sums_[kSums] = {}, counts_[kSums] = {};
  std::size_t next_ = 0;  // index of the sum that the next value joins
};
/// Returns the mean of the values that are not NaN; nothing if there are none.
std::optional<double> MeanOfSeen(std::span<const double> values);
/// Returns the share of values below `limit_mm`, among those that are not NaN.
std::optional<double> ShareBelow(std::span<const double> values, double limit_mm);
/// Returns the mean of ShareBelow at 0, 5, …, 150 mm, as MPI-INF-3DHP's code computes it.
std::optional<double> AucTo150(std::span<const double> values);
/// Returns the share of the truth's joints, over all its frames, that both show; nothing if the truth shows none.
std::optional<double> SeenShare(const EvaluatedPair& pair);

/// Returns the mean length of the difference between the second differences of answer and truth, over all joints and
/// frames whose three frames both show; metres per frame².
std::optional<double> AccelerationError(const PointTracks& found, const PointTracks& truth);
/// Returns the same after the answer is moved root onto root in each frame, without the first and the last frame
/// (WHAM).
std::optional<double> RootAccelerationError(const EvaluatedPair& pair);
/// Returns the mean length of the answer's third differences × rate³ ÷ 10 (WHAM).
std::optional<double> Jitter(const PointTracks& found, double rate_hz);
/// Returns the root's mean error after the rigid transformation that fits its whole path best, in per cent of the true
/// path's length (WHAM). Nothing if the true root does not move, or if fewer than three frames are seen.
std::optional<double> RootTranslationError(const EvaluatedPair& pair);

/// Returns the share of steps between frames in which a toe skates, as GMD's code computes it.
std::optional<double> SkatingRatio(const PointTracks& feet, double rate_hz);
/// Returns the mean speed of toes below 5 cm, m/s, as Kimodo's code computes it.
std::optional<double> SkateFromHeight(const PointTracks& feet, double rate_hz);
/// Returns the mean speed of heels and toes while `contacts` (frames × columns of feet) says that they touch the floor,
/// m/s, as Kimodo's code computes it.
std::optional<double> SkateFromContacts(const PointTracks& feet, const std::vector<bool>& contacts, double rate_hz);
/// Returns F1 of the answer's contacts against the truth's; nothing without contacts in either.
std::optional<double> ContactF1(const std::vector<bool>& found, const std::vector<bool>& truth);
/// Returns PFC as EDGE's code computes it, with Y up and the motion's own rate.
std::optional<double> PhysicalFootContact(const PointTracks& feet, std::span<const glm::dvec3> root, double rate_hz);
/// Returns the mean depth of the answer's lowest joint below height 0, and its mean height above, millimetres.
struct FloorErrors {
  std::optional<double> penetration_mm, floating_mm;
};
FloorErrors MeasureFloor(const PointTracks& found);

/// The global rotations of answer and truth as channels (QuaternionChannels). The signs of the answer's quaternions are
/// chosen nearest to the truth's. NaN where a joint is not seen by both; nothing if one of them has no rotations.
struct RotationChannels {
  ChannelTracks found, truth;
};
std::optional<RotationChannels> RotationsOf(const EvaluatedPair& pair);

/// Returns the mean absolute difference of the angles at the middle of three points, degrees. Points come in threes:
/// hip, knee, ankle; shoulder, elbow, wrist. Nothing if no three are seen by both.
std::optional<double> BendErrorDeg(const PointTracks& found, const PointTracks& truth,
                                   std::span<const std::array<std::size_t, 3>> bends);

}  // namespace etude
