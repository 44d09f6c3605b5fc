#include "engine/recognition/pose_vector.h"

#include <algorithm>
#include <cmath>

#include "engine/recognition/sight.h"

namespace etude {
namespace {

using enum Role;

/// A part of the body: the vector between two joints. For PoseParts::kJoints, it starts at the hip centre.
struct Part {
  Role from, to;
};
constexpr std::size_t kWays = kPosePartCount - 1;
constexpr std::array<Part, kWays> kJointParts = {{{kHipCentre, kHead},
                                                  {kHipCentre, kLeftShoulder},
                                                  {kHipCentre, kRightShoulder},
                                                  {kHipCentre, kLeftElbow},
                                                  {kHipCentre, kRightElbow},
                                                  {kHipCentre, kLeftWrist},
                                                  {kHipCentre, kRightWrist},
                                                  {kHipCentre, kLeftKnee},
                                                  {kHipCentre, kRightKnee},
                                                  {kHipCentre, kLeftAnkle},
                                                  {kHipCentre, kRightAnkle}}};
constexpr std::array<Part, kWays> kLimbParts = {{{kHipCentre, kShoulderCentre},
                                                 {kRightShoulder, kLeftShoulder},
                                                 {kShoulderCentre, kHead},
                                                 {kLeftShoulder, kLeftElbow},
                                                 {kRightShoulder, kRightElbow},
                                                 {kLeftElbow, kLeftWrist},
                                                 {kRightElbow, kRightWrist},
                                                 {kLeftHip, kLeftKnee},
                                                 {kRightHip, kRightKnee},
                                                 {kLeftKnee, kLeftAnkle},
                                                 {kRightKnee, kRightAnkle}}};

const std::array<Part, kWays>& WaysOf(PoseParts parts) {
  return parts == PoseParts::kJoints ? kJointParts : kLimbParts;
}

constexpr double kTrunk = 0.5;    // trunk length to which bodies are scaled, metres
constexpr double kHips = 0.9;     // standing hip height of a body with that trunk, metres
constexpr double kStanding = 80;  // the value of the feature Posture when standing
constexpr double kSmoothing = 1;  // time constant of heading and trunk length, seconds

double TrunkLength(const SensedFrame& skeleton) {
  return glm::distance(skeleton[kHipCentre].position, skeleton[kShoulderCentre].position);
}

}  // namespace

void SquaredDistances(const PoseVector& seen, std::span<const PoseVector> taught, std::span<double> out) {
  double total = 0;
  for (const double weight : seen.weights) total += weight;
  // Compute two distances at a time, so that the compiler vectorises; if their count is odd, compute the last twice.
  for (std::size_t j = 0; j < taught.size(); j += 2) {
    const std::size_t next = std::min(j + 1, taught.size() - 1);
    double sum = 0, sum_next = 0;
    for (std::size_t i = 0; i < kPosePartCount; ++i) {
      const glm::dvec3 gap = seen.parts[i] - taught[j].parts[i], gap_next = seen.parts[i] - taught[next].parts[i];
      sum += seen.weights[i] * glm::dot(gap, gap);
      sum_next += seen.weights[i] * glm::dot(gap_next, gap_next);
    }
    out[j] = total > 0 ? sum / total : 0.0;
    out[next] = total > 0 ? sum_next / total : 0.0;
  }
}

double SquaredDistance(const PoseVector& seen, const PoseVector& taught) {
  double distance = 0;
  SquaredDistances(seen, {&taught, 1}, {&distance, 1});
  return distance;
}

PoseVector MeanOf(std::span<const PoseVector> poses) {
  PoseVector mean{.parts = {}, .weights = poses.front().weights};
  for (const PoseVector& pose : poses) {
    for (std::size_t i = 0; i < kPosePartCount; ++i) mean.parts[i] += pose.parts[i] / static_cast<double>(poses.size());
  }
  return mean;
}

PoseVector Mirrored(const PoseVector& pose, PoseParts parts) {
  // A part's mirror image is the part between the mirrored joints, possibly in the opposite direction.
  const auto& ways = WaysOf(parts);
  const glm::dvec3 flip(-1, 1, 1);
  PoseVector mirrored = pose;
  for (std::size_t i = 0; i < kWays; ++i) {
    for (std::size_t j = 0; j < kWays; ++j) {
      const bool is_image = ways[j].from == Mirrored(ways[i].from) && ways[j].to == Mirrored(ways[i].to);
      const bool is_reverse = ways[j].from == Mirrored(ways[i].to) && ways[j].to == Mirrored(ways[i].from);
      if (!is_image && !is_reverse) continue;
      mirrored.parts[j] = flip * pose.parts[i] * (is_image ? 1.0 : -1.0);
      mirrored.weights[j] = pose.weights[i];
    }
  }
  return mirrored;
}

StepDescriber::StepDescriber(PoseParts parts, const TrackingWeights& weights, double rate_hz)
    : parts_(parts), weights_(weights), rate_hz_(rate_hz) {}

void StepDescriber::Follow(const SensedFrame& skeleton) {
  const double share = follows_ ? 1.0 - std::exp(-1.0 / (kSmoothing * rate_hz_)) : 1.0;
  const glm::dvec3 facing = facing_ + share * (Facing(PoseOf(skeleton)) - facing_);
  if (glm::length(facing) > 1e-6) facing_ = facing;  // a sudden half turn has no mean direction
  trunk_m_ += share * (TrunkLength(skeleton) - trunk_m_);
  follows_ = true;
}

PoseVector StepDescriber::Describe(const SeenFrame& frame) {
  // Express each part in the body's frame (left, up, ahead), scaled or normalised.
  Follow(frame.skeleton);
  const glm::dvec3 ahead = glm::normalize(facing_), left(ahead.z, 0, -ahead.x);
  const double scale = trunk_m_ > 0 ? kTrunk / trunk_m_ : 1.0;
  PoseVector pose;
  const auto& ways = WaysOf(parts_);
  for (std::size_t i = 0; i < kWays; ++i) {
    const SensedJoint &from = frame.skeleton[ways[i].from], &to = frame.skeleton[ways[i].to];
    const glm::dvec3 way = to.position - from.position;
    const double length = glm::length(way);
    const double factor = parts_ == PoseParts::kJoints ? scale : length > 0 ? 1.0 / length : 0.0;
    pose.parts[i] = factor * glm::dvec3(glm::dot(way, left), way.y, glm::dot(way, ahead));
    pose.weights[i] = weights_.Of(std::max(from.state, to.state));
  }
  // The last part is the height of the hips relative to standing.
  pose.parts.back().y = kHips * (frame.features.features[Feature::kPosture] / kStanding - 1.0);
  pose.weights.back() = weights_.Of(frame.features.StateOf(Feature::kPosture));
  return pose;
}

int StepDescriber::Update(const SeenFrame& frame) {
  // Add this frame to the sum of the current step.
  if (frame.features.body_seen) {
    const PoseVector pose = Describe(frame);
    for (std::size_t i = 0; i < kPosePartCount; ++i) {
      sum_.parts[i] += pose.parts[i];
      sum_.weights[i] += pose.weights[i];
    }
    ++summed_;
  }
  // Count the steps that end with this frame.
  const auto steps_until = [&](long frames) {
    return static_cast<long>(std::floor(static_cast<double>(frames) * kStepsPerSecond / rate_hz_));
  };
  const long completed = steps_until(frame_ + 1) - steps_until(frame_);
  ++frame_;
  if (completed == 0) return 0;

  // Finish the step as the mean of its frames; it is nullopt if no frame showed a body.
  step_.reset();
  if (summed_ > 0) {
    step_ = sum_;
    for (std::size_t i = 0; i < kPosePartCount; ++i) {
      step_->parts[i] /= summed_;
      step_->weights[i] /= summed_;
    }
  }
  sum_ = {};
  summed_ = 0;
  return static_cast<int>(completed);
}

std::vector<PoseVector> DescribeStream(const SkeletonStream& stream, PoseParts parts) {
  std::vector<PoseVector> steps;
  LiveSight sight({}, stream.rate_hz);
  StepDescriber describer(parts, {}, stream.rate_hz);
  for (const SensedFrame& frame : stream.frames) {
    const int completed = describer.Update(sight.Update(frame));
    if (describer.Step()) steps.insert(steps.end(), static_cast<std::size_t>(completed), *describer.Step());
  }
  return steps;
}

StepFollower::StepFollower(PoseParts parts, const TrackingWeights& weights, std::size_t moves, double rate_hz)
    : describer_(parts, weights, rate_hz), spotted_(moves, 0.0) {}

void StepFollower::Ask(std::optional<std::size_t> move) {
  asked_ = move;
  best_ = 0;
  Open(move);
}

Evidence StepFollower::Update(const SeenFrame& frame) {
  const int completed = describer_.Update(frame);
  if (completed > 0) std::ranges::fill(spotted_, 0.0);
  for (int i = 0; i < completed && describer_.Step(); ++i) {
    best_ = std::max(best_, Take(*describer_.Step(), spotted_));
  }
  return {.asked = best_, .spotted = spotted_};
}

}  // namespace etude
