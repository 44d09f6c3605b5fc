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

/// Positions of some points over time: frames × points, metres, Y up. NaN: the point is not seen.
struct PointTracks {
  std::size_t points = 0;
  std::vector<glm::dvec3> positions;

  std::size_t FrameCount() const { return points == 0 ? 0 : positions.size() / points; }
  std::span<const glm::dvec3> Frame(std::size_t frame) const { return {&positions[frame * points], points}; }
};

/// An answer and its truth, frame by frame. Both have the same joints in the same order, and the same rate.
struct EvaluatedPair {
  double rate_hz = 30;
  PointTracks found, truth;
  /// The position of each frame's root, by which poses are aligned; `Match` says which point is the root. Empty if
  /// answer or truth lacks that point.
  std::vector<glm::dvec3> found_root, true_root;
  /// Global rotations of the joints, frames × joints. Each is empty if its file has no rotations.
  std::vector<glm::dquat> found_turns, true_turns;
  /// The answer's feet: left ankle, left toes, right ankle, right toes. Empty if the answer lacks one of these joints.
  PointTracks feet;
  /// The contacts with the floor that each file states, frames × the four columns of `feet`; the ankle columns hold the
  /// heels' contacts. Empty if the file states none.
  std::vector<bool> found_contacts, true_contacts;
  /// The number of positions (joints × frames) that the truth shows of joints that the answer does not have at all.
  std::size_t without_joint = 0;
};

/// The mean of all added values, without the NaN values.
class SeenMean {
 public:
  void Add(std::span<const double> values);
  /// Returns the mean; nothing if all values are NaN.
  std::optional<double> Value() const;

 private:
  // Values are added to four sums in turn, because each addition to a single sum would have to wait for the previous
  // one.
  static constexpr std::size_t kSums = 4;
  double sums_[kSums] = {}, counts_[kSums] = {};
  std::size_t next_ = 0;  // index of the sum to which the next value is added
};
/// Returns the mean of the values that are not NaN; nothing if all are NaN.
std::optional<double> MeanOfSeen(std::span<const double> values);
/// Returns the share below `limit_mm` among the values that are not NaN; nothing if all are NaN.
std::optional<double> ShareBelow(std::span<const double> values, double limit_mm);
/// Returns the mean of ShareBelow over the limits 0, 5, …, 150 mm, as MPI-INF-3DHP's code computes it.
std::optional<double> AucTo150(std::span<const double> values);
/// Returns the share of joints seen in the answer among the joints seen in the truth, over all frames; joints that the
/// answer does not have at all count as not seen. Returns nothing if no joint is seen in the truth.
std::optional<double> SeenShare(const EvaluatedPair& pair);

/// Returns the mean length of the difference between the answer's and the truth's second differences, metres per
/// frame². The mean is over all joints and all groups of three frames in which the joint is seen in answer and truth.
std::optional<double> AccelerationError(const PointTracks& found, const PointTracks& truth);
/// Returns AccelerationError after the answer's root is moved onto the true root in each frame (WHAM). The first and
/// the last frame are left out.
std::optional<double> RootAccelerationError(const EvaluatedPair& pair);
/// Returns jitter: the mean length of the answer's third differences × rate³, in units of 10 m/s³ (WHAM).
std::optional<double> Jitter(const PointTracks& found, double rate_hz);
/// Returns the mean error of the root's path after the rigid transformation that fits the whole path best, in per cent
/// of the true path's length (WHAM). Returns nothing if the true root does not move, or if the root is seen in fewer
/// than three frames.
std::optional<double> RootTranslationError(const EvaluatedPair& pair);

/// Returns the share of steps between frames in which at least one foot's toes skate, as GMD's code computes it.
std::optional<double> SkatingRatio(const PointTracks& feet, double rate_hz);
/// Returns the mean speed of toes that are lower than 5 cm, m/s, as Kimodo's code computes it.
std::optional<double> SkateFromHeight(const PointTracks& feet, double rate_hz);
/// Returns the mean speed of ankles and toes over the frames in which `contacts` (frames × columns of feet) states a
/// contact with the floor, m/s, as Kimodo's code computes it.
std::optional<double> SkateFromContacts(const PointTracks& feet, const std::vector<bool>& contacts, double rate_hz);
/// Returns the F1 score of the answer's contacts against the true contacts. Returns nothing if only one of the two
/// files states contacts, or if there is no contact in either.
std::optional<double> ContactF1(const std::vector<bool>& found, const std::vector<bool>& truth);
/// Returns PFC (physical foot contact) as EDGE's code computes it, but with Y up and at the motion's own rate.
std::optional<double> PhysicalFootContact(const PointTracks& feet, std::span<const glm::dvec3> root, double rate_hz);
/// The mean depth of the answer's lowest joint below height 0, and the mean height of this joint above 0, millimetres.
struct FloorErrors {
  std::optional<double> penetration_mm, floating_mm;
};
FloorErrors MeasureFloor(const PointTracks& found);

/// The global rotations of answer and truth as channels (QuaternionChannels). The sign of the answer's first known
/// quaternion of each joint is chosen by the truth's quaternion at the same frame (`like`). A value is NaN unless the
/// joint is seen in both motions. There are no channels if answer or truth has no rotations.
struct RotationChannels {
  ChannelTracks found, truth;
};
std::optional<RotationChannels> RotationsOf(const EvaluatedPair& pair);

/// Returns the mean absolute error of the bend angles, degrees. Each entry of `bends` holds three points (hip, knee,
/// ankle; or shoulder, elbow, wrist); the bend angle is at the middle point. A frame counts for an entry if the entry's
/// three points are seen in both motions. Returns nothing if no frame counts.
std::optional<double> BendErrorDeg(const PointTracks& found, const PointTracks& truth,
                                   std::span<const std::array<std::size_t, 3>> bends);

}  // namespace etude
