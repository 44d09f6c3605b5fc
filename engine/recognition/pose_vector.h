#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "engine/recognition/recogniser.h"

namespace etude {

/// The parts that describe a pose, each a vector seen from a body that faces +Z.
enum class PoseParts {
  kJoints,  ///< where joints are from the hip centre, metres, the trunk scaled to 50 cm
  kLimbs,   ///< which way limbs point, unit vectors
};
/// The number of parts: eleven joints or limbs, and the lift of the hips.
constexpr std::size_t kPosePartCount = 12;

/// One pose, comparable between bodies, places and headings.
struct PoseVector {
  std::array<glm::dvec3, kPosePartCount> parts{};
  std::array<double, kPosePartCount> weights{};  ///< how much each counts, in [0, 1]
};

/// Returns the mean squared distance of two poses' parts, weighed by how `seen` was seen; the parts' own unit, squared.
/// 0 weight in all: nothing is known, and nothing differs.
double SquaredDistance(const PoseVector& seen, const PoseVector& taught);

/// The mean of what at least one pose is described by; of weight 1 or 0 as the first.
PoseVector MeanOf(std::span<const PoseVector> poses);

/// Returns the pose with left and right exchanged.
PoseVector Mirrored(const PoseVector& pose, PoseParts parts);

/// The steps a second in which motions are compared: fast enough for a dance, half of what sensors deliver.
constexpr double kStepsPerSecond = 15;

/// Describes a stream frame by frame, causally, and gathers frames into steps of equal length, each their mean. Heading
/// and trunk length are smoothed over a second: people turn slowly, and sensors jitter.
class StepDescriber {
 public:
  /// `rate_hz` > 0.
  StepDescriber(PoseParts parts, const SightWeights& weights, double rate_hz);

  /// Takes a frame, and returns how many steps it completes: mostly none or one, several where frames are fewer than
  /// steps. They all show `Step`.
  int Update(const SeenFrame& frame);
  /// Returns the step completed last; nothing when no body was seen in it.
  const std::optional<PoseVector>& Step() const { return step_; }

 private:
  PoseVector Describe(const SeenFrame& frame);
  void Follow(const SensedFrame& skeleton);

  PoseParts parts_;
  SightWeights weights_;
  double rate_hz_;
  long frame_ = 0;
  bool follows_ = false;  // whether a body was seen yet
  glm::dvec3 facing_{0, 0, 1};
  double trunk_m_ = 0;
  PoseVector sum_;  // of the frames of this step
  int summed_ = 0;
  std::optional<PoseVector> step_;
};

/// Lists the steps of a recorded stream, those without a body left out.
std::vector<PoseVector> DescribeStream(const SkeletonStream& stream, PoseParts parts);

/// A follower that compares motions in steps: what it answers changes with every step, and stays between them.
class StepFollower : public MoveFollower {
 public:
  /// `rate_hz` > 0.
  StepFollower(PoseParts parts, const SightWeights& weights, std::size_t moves, double rate_hz);

  void Ask(std::optional<std::size_t> move) final;
  Evidence Update(const SeenFrame& frame) final;

 protected:
  std::optional<std::size_t> asked() const { return asked_; }

 private:
  /// A window opens, or none is open any more.
  virtual void Open(std::optional<std::size_t> move) = 0;
  /// The next step. Gives the evidence that the performance asked for ends now (0 when none is), and fills in that of
  /// every move in `spotted`.
  virtual double Take(const PoseVector& step, std::span<double> spotted) = 0;

  StepDescriber describer_;
  std::optional<std::size_t> asked_;
  double best_ = 0;  // of the performance asked for
  std::vector<double> spotted_;
};

}  // namespace etude
