#include "engine/recognition/key_pose.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace etude {
namespace {

double WeightOf(TrackingState state, const KeyPoseOptions& options) {
  if (options.weights == Weighting::kFixed) return 1.0;
  switch (state) {
    case TrackingState::kTracked:
      return options.tracked_weight;
    case TrackingState::kInferred:
      return options.inferred_weight;
    case TrackingState::kNotTracked:
      return options.not_tracked_weight;
  }
  return 0.0;
}

/// The weighted mean over the pose's targets of `grade(error / tolerance)`.
template <typename Grade>
double WeightedMean(const FeatureFrame& frame, const TaughtPose& pose, const KeyPoseOptions& options, Grade grade) {
  double total = 0, sum = 0;
  for (const PoseTarget& target : pose.targets) {
    const double weight = WeightOf(frame.states[static_cast<std::size_t>(target.feature)], options);
    const double error = std::abs(frame.features[target.feature] - target.degrees);
    total += weight;
    sum += weight * grade(error / target.tolerance_deg);
  }
  return total > 0 ? sum / total : 0.0;
}

}  // namespace

double MatchedShare(const FeatureFrame& frame, const TaughtPose& pose, const KeyPoseOptions& options) {
  return WeightedMean(frame, pose, options, [](double error) { return error <= 1.0 ? 1.0 : 0.0; });
}

double SoftMatch(const FeatureFrame& frame, const TaughtPose& pose, const KeyPoseOptions& options) {
  return WeightedMean(frame, pose, options, [](double error) { return 1.0 / (1.0 + error * error); });
}

KeyPoseRecogniser::KeyPoseRecogniser(const TaughtMove& move, const KeyPoseOptions& options, int span_frames)
    : move_(move), options_(options), span_frames_(span_frames) {
  assert(!move.poses.empty() && options.hold_frames >= 1);
  poses_.resize(move.poses.size());
  for (PoseProgress& progress : poses_) progress.recent.assign(static_cast<std::size_t>(options.hold_frames), 0.0);
  best_scores_.assign(move.poses.size(), 0.0);
}

bool KeyPoseRecogniser::Update(const FeatureFrame& frame) {
  const int now = frame_++;
  if (!frame.body_seen) return false;
  const std::size_t slot = static_cast<std::size_t>(seen_++ % options_.hold_frames);

  // From the last pose to the first: each reads its predecessor's state of the previous frame, not of this one.
  constexpr double kRounding = 1e-9;  // a share of exactly the threshold counts, whatever the weights
  for (std::size_t k = poses_.size(); k-- > 0;) {
    PoseProgress& progress = poses_[k];
    const bool matched = MatchedShare(frame, move_.poses[k], options_) >= options_.threshold - kRounding;
    progress.held = matched ? progress.held + 1 : 0;
    if (progress.held >= options_.hold_frames) progress.started = k == 0 ? std::optional(now) : poses_[k - 1].started;

    progress.recent[slot] = SoftMatch(frame, move_.poses[k], options_);
    const double reached_before = k == 0 ? 1.0 : best_scores_[k - 1];
    best_scores_[k] = std::max(best_scores_[k], std::min(HeldScore(progress), reached_before));
  }

  PoseProgress& last = poses_.back();
  if (last.held == 0) armed_ = true;
  const bool complete = last.held >= options_.hold_frames && last.started && now - *last.started <= span_frames_;
  if (!complete || !armed_) return false;
  armed_ = false;
  for (PoseProgress& progress : poses_) progress.started.reset();
  return true;
}

double KeyPoseRecogniser::HeldScore(const PoseProgress& progress) const {
  return *std::min_element(progress.recent.begin(), progress.recent.end());
}

Judgement JudgeWindow(std::span<const FeatureFrame> window, const TaughtMove& move, const KeyPoseOptions& options) {
  Judgement judgement;
  KeyPoseRecogniser recogniser(move, options, static_cast<int>(window.size()));
  for (std::size_t i = 0; i < window.size(); ++i) {
    const bool recognised = recogniser.Update(window[i]);
    if (recognised && !judgement.recognised_at) judgement.recognised_at = static_cast<int>(i);
    judgement.running_score.push_back(recogniser.Score());
  }
  judgement.score = recogniser.Score();
  return judgement;
}

std::vector<int> FindMove(std::span<const FeatureFrame> frames, const TaughtMove& move, const KeyPoseOptions& options) {
  std::vector<int> found;
  KeyPoseRecogniser recogniser(move, options, move.span_frames);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (recogniser.Update(frames[i])) found.push_back(static_cast<int>(i));
  }
  return found;
}

}  // namespace etude
