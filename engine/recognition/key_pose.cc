#include "engine/recognition/key_pose.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "engine/recognition/recogniser.h"
#include "engine/recognition/taught_move.h"

namespace etude {
namespace {

/// Returns how well a frame matches a key pose, in [0, 1]. The frame must show a body.
using PoseMatcher = std::function<double(const FeatureFrame& frame, const TaughtPose& pose)>;

/// The key poses of one move, and the longest duration of a performance, in seconds.
struct Sequence {
  std::vector<TaughtPose> poses;
  double span_s;
};

struct Taught {
  std::vector<Sequence> moves;
  int hold_frames;
  PoseMatcher match;
};

class Follower final : public MoveFollower {
 public:
  Follower(const Taught& taught, double rate_hz) : taught_(taught), spotted_(taught.moves.size(), 0.0) {
    for (const Sequence& move : taught.moves) {
      const int span_frames = static_cast<int>(std::ceil(move.span_s * rate_hz));
      sequences_.emplace_back(move.poses.size(), taught.hold_frames, span_frames);
    }
  }

  void Ask(std::optional<std::size_t> move) override {
    asked_ = move;
    if (move) sequences_[*move].Open();
  }

  Evidence Update(const SeenFrame& frame) override {
    for (std::size_t i = 0; i < sequences_.size(); ++i) {
      matches_.clear();
      if (frame.features.body_seen) {
        for (const TaughtPose& pose : taught_.moves[i].poses) matches_.push_back(taught_.match(frame.features, pose));
      }
      sequences_[i].Update(matches_);
      spotted_[i] = sequences_[i].Spotted();
    }
    return {.asked = asked_ ? sequences_[*asked_].Asked() : 0.0, .spotted = spotted_};
  }

 private:
  const Taught& taught_;
  std::vector<PoseSequence> sequences_;  // one sequence per move
  std::vector<double> matches_, spotted_;
  std::optional<std::size_t> asked_;
};

/// Makes a recogniser that detects a move when its key poses are reached in order (PoseSequence); `match` compares one
/// frame with one key pose.
std::unique_ptr<Recogniser> MakePoseSequenceRecogniser(std::span<const TaughtMove> taught, int hold_frames,
                                                       PoseMatcher match) {
  Taught sequences{.moves = {}, .hold_frames = hold_frames, .match = std::move(match)};
  for (const TaughtMove& move : taught) sequences.moves.push_back({move.poses, move.span_s});
  return MakeRecogniser(
      [sequences = std::move(sequences)](double rate_hz) { return std::make_unique<Follower>(sequences, rate_hz); });
}

/// Returns the overlap of a feature's membership grades at two inputs, in [0, 1].
double Overlap(Feature feature, double seen, double taught, const Memberships& memberships) {
  const Universe& universe = memberships.universes[static_cast<std::size_t>(feature)];
  const std::size_t first = FirstTermOf(feature), last = first + TermsOf(feature).size();
  double common = 0, all = 0;
  for (std::size_t term = first; term < last; ++term) {
    const Shape& shape = memberships.shapes[term];
    const double a = GradeOf(shape, std::clamp(seen, universe.low, universe.high));
    const double b = GradeOf(shape, std::clamp(taught, universe.low, universe.high));
    common += std::min(a, b);
    all += std::max(a, b);
  }
  return all > 0 ? common / all : 1.0;
}

}  // namespace

PoseSequence::PoseSequence(std::size_t poses, int hold_frames, int span_frames)
    : hold_frames_(static_cast<std::size_t>(hold_frames)),
      span_frames_(span_frames),
      recent_(poses, std::vector<double>(hold_frames_, 0.0)),
      asked_(poses, 0.0) {
  assert(poses >= 1 && hold_frames >= 1 && span_frames >= 0);
}

void PoseSequence::Open() {
  seen_since_open_ = 0;
  std::ranges::fill(asked_, 0.0);
}

void PoseSequence::Update(std::span<const double> matches) {
  const int now = frame_++;
  // A frame without a body only resets the spotted score.
  spotted_ = 0;
  if (matches.empty()) return;
  const std::size_t slot = seen_++ % hold_frames_;
  ++seen_since_open_;

  std::vector<double> held;
  // Score each pose by its worst match in the last `hold_frames_` frames.
  for (std::size_t k = 0; k < recent_.size(); ++k) {
    recent_[k][slot] = matches[k];
    held.push_back(*std::ranges::min_element(recent_[k]));
  }
  // Extend the requested passage from the last pose to the first, so that each pose uses its predecessor's score of the
  // previous frame.
  for (std::size_t k = held.size(); k-- > 0 && seen_since_open_ >= hold_frames_;) {
    asked_[k] = std::max(asked_[k], std::min(held[k], k == 0 ? 1.0 : asked_[k - 1]));
  }
  // Score the best passage that ends now and lasts at most `span_frames_`.
  while (!within_span_.empty() && within_span_.front().frame < now - span_frames_) within_span_.pop_front();
  spotted_ = BestPassageEndingIn(held);
  if (held.size() > 1) within_span_.push_back({now, std::move(held)});
}

double PoseSequence::BestPassageEndingIn(std::span<const double> held) const {
  if (held.size() == 1 || held.back() == 0) return held.back();
  std::vector<double> best(held.size() - 1, 0.0);
  for (const Held& before : within_span_) {
    for (std::size_t k = best.size(); k-- > 0;) {
      best[k] = std::max(best[k], std::min(before.scores[k], k == 0 ? 1.0 : best[k - 1]));
    }
  }
  return std::min(best.back(), held.back());
}

double MatchOf(const FeatureFrame& frame, const TaughtPose& pose, const TrackingWeights& weights,
               const KeyPoseOptions& options) {
  struct Angle {
    double error;  // the angle's error divided by its tolerance
    double weight;
  };
  std::array<Angle, kFeatureCount> angles;
  assert(pose.targets.size() <= angles.size());
  double total = 0;
  std::size_t count = 0;
  // Collect each angle's error and weight.
  for (const PoseTarget& target : pose.targets) {
    const double tolerance = target.tolerance_deg * options.tolerance_scale;
    const double weight = weights.Of(frame.StateOf(target.feature));
    angles[count++] = {std::abs(frame.features[target.feature] - target.degrees) / tolerance, weight};
    total += weight;
  }
  if (!(total > 0)) return 0.0;
  // Sort by error, and find the error up to which the angles have the required share of all weight.
  std::sort(angles.begin(), angles.begin() + static_cast<std::ptrdiff_t>(count),
            [](const Angle& a, const Angle& b) { return a.error < b.error; });
  constexpr double kRounding = 1e-9;  // rounding must not exclude a share of exactly `pose_share`
  double within = 0, factor = 0;
  for (std::size_t i = 0; i < count && within < (options.pose_share - kRounding) * total; ++i) {
    within += angles[i].weight;
    factor = angles[i].error;
  }
  return 1.0 / (1.0 + factor * factor);
}

std::unique_ptr<Recogniser> MakeKeyPoseRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                  const KeyPoseOptions& options) {
  return MakePoseSequenceRecogniser(taught, options.hold_frames,
                                    [weights, options](const FeatureFrame& frame, const TaughtPose& pose) {
                                      return MatchOf(frame, pose, weights, options);
                                    });
}

double RuleStrength(const FeatureFrame& frame, const TaughtPose& pose, const TrackingWeights& weights,
                    const Memberships& memberships) {
  double strength = 1, most = 0;
  for (const PoseTarget& target : pose.targets) {
    const double weight = weights.Of(frame.StateOf(target.feature));
    const double overlap = Overlap(target.feature, frame.features[target.feature], target.degrees, memberships);
    strength = std::min(strength, std::max(overlap, 1.0 - weight));
    most = std::max(most, weight);
  }
  return most > 0 ? strength : 0.0;
}

std::unique_ptr<Recogniser> MakeFuzzyRulesRecogniser(std::span<const TaughtMove> taught, const TrackingWeights& weights,
                                                     const FuzzyRulesOptions& options) {
  return MakePoseSequenceRecogniser(taught, options.hold_frames,
                                    [weights](const FeatureFrame& frame, const TaughtPose& pose) {
                                      return RuleStrength(frame, pose, weights, PaperMemberships());
                                    });
}

std::vector<std::optional<int>> WhenReached(std::span<const TaughtPose> poses, std::span<const FeatureFrame> frames,
                                            const TrackingWeights& weights, const KeyPoseOptions& options) {
  constexpr double kReached = 0.5;
  std::vector<std::optional<int>> reached;
  for (std::size_t count = 1; count <= poses.size(); ++count) {
    PoseSequence sequence(count, options.hold_frames, 0);
    sequence.Open();
    auto& when = reached.emplace_back();
    for (std::size_t frame = 0; frame < frames.size() && !when; ++frame) {
      std::vector<double> matches;
      for (std::size_t k = 0; k < count && frames[frame].body_seen; ++k) {
        matches.push_back(MatchOf(frames[frame], poses[k], weights, options));
      }
      sequence.Update(matches);
      if (sequence.Asked() >= kReached) when = static_cast<int>(frame);
    }
  }
  return reached;
}

}  // namespace etude
