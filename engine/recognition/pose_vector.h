#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/recognition/recogniser.h"

namespace etude {

/// The parts that describe a pose. Each is a vector in the frame of a body that faces +Z.
enum class PoseParts {
  kJoints,  ///< positions of joints relative to the hip centre, metres, with the trunk scaled to 50 cm
  kLimbs,   ///< directions of limbs, unit vectors
};
/// The number of parts: eleven joints or limbs, and the height of the hips.
constexpr std::size_t kPosePartCount = 12;

/// One pose, independent of body size, position and heading.
struct PoseVector {
  std::array<glm::dvec3, kPosePartCount> parts{};
  std::array<double, kPosePartCount> weights{};  ///< weight of each part, in [0, 1]
};

/// Returns the mean squared distance of the poses' parts, weighted by `seen.weights`, in the square of the parts' unit.
/// Returns 0 if all weights are 0.
double SquaredDistance(const PoseVector& seen, const PoseVector& taught);
/// Computes the SquaredDistance of `seen` to every pose of `taught`.
void SquaredDistances(const PoseVector& seen, std::span<const PoseVector> taught, std::span<double> out);

/// Returns the mean of `poses`, which must not be empty, with the weights of the first pose.
PoseVector MeanOf(std::span<const PoseVector> poses);

/// Returns the pose with left and right exchanged.
PoseVector Mirrored(const PoseVector& pose, PoseParts parts);

/// The number of steps per second at which motions are compared. The rate is high enough for dances, and half the frame
/// rate of usual sensors.
constexpr double kStepsPerSecond = 15;

/// Describes a stream frame by frame, causally, and averages the frames in steps of equal length. Heading and trunk
/// length are smoothed over a second, because people turn slowly and sensors jitter.
class StepDescriber {
 public:
  /// Creates a describer for frames at `rate_hz` > 0.
  StepDescriber(PoseParts parts, const TrackingWeights& weights, double rate_hz);

  /// Takes a frame and returns the number of steps that it completes: usually 0 or 1, more if the frame rate is below
  /// the step rate. If it completes several steps, all of them are equal to `Step`.
  int Update(const SeenFrame& frame);
  /// Returns the last completed step; nullopt if no body was seen in it.
  const std::optional<PoseVector>& Step() const { return step_; }

 private:
  PoseVector Describe(const SeenFrame& frame);
  void Follow(const SensedFrame& skeleton);

  PoseParts parts_;
  TrackingWeights weights_;
  double rate_hz_;
  long frame_ = 0;
  bool follows_ = false;  // true once a body was seen
  glm::dvec3 facing_{0, 0, 1};
  double trunk_m_ = 0;
  PoseVector sum_;  // sum of the poses in this step's frames
  int summed_ = 0;
  std::optional<PoseVector> step_;
};

/// Returns the steps of a recorded stream; steps without a body are left out.
std::vector<PoseVector> DescribeStream(const SkeletonStream& stream, PoseParts parts);

/// A MoveFollower that compares motions in steps. Its evidence changes only when a step is completed.
class StepFollower : public MoveFollower {
 public:
  /// `rate_hz` > 0 is the stream's frame rate; `moves` is the number of taught moves.
  StepFollower(PoseParts parts, const TrackingWeights& weights, std::size_t moves, double rate_hz);

  void Ask(std::optional<std::size_t> move) final;
  Evidence Update(const SeenFrame& frame) final;

 protected:
  std::optional<std::size_t> asked() const { return asked_; }

 private:
  /// Is called when a window (the time in which a move is asked for) opens for `move`, or with nullopt when the window
  /// closes.
  virtual void Open(std::optional<std::size_t> move) = 0;
  /// Takes the next step. Returns the evidence that the asked performance ends now (0 without an asked move), and
  /// writes the evidence of every move to `spotted`.
  virtual double Take(const PoseVector& step, std::span<double> spotted) = 0;

  StepDescriber describer_;
  std::optional<std::size_t> asked_;
  double best_ = 0;  // largest evidence in this window
  std::vector<double> spotted_;
};

}  // namespace etude
