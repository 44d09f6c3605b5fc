#include "engine/recognition/pose_sequence_recogniser.h"

#include <cmath>
#include <vector>

#include "engine/recognition/pose_sequence.h"

namespace etude {
namespace {

/// The key poses of one move, and how long it may take.
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
  std::vector<PoseSequence> sequences_;  // one per move
  std::vector<double> matches_, spotted_;
  std::optional<std::size_t> asked_;
};

class PoseSequenceRecogniser final : public Recogniser {
 public:
  explicit PoseSequenceRecogniser(Taught taught) : taught_(std::move(taught)) {}

  std::unique_ptr<MoveFollower> Follow(double rate_hz) const override {
    return std::make_unique<Follower>(taught_, rate_hz);
  }

 private:
  Taught taught_;
};

}  // namespace

std::unique_ptr<Recogniser> MakePoseSequenceRecogniser(std::span<const TaughtMove> taught, int hold_frames,
                                                       PoseMatcher match) {
  Taught sequences{.moves = {}, .hold_frames = hold_frames, .match = std::move(match)};
  for (const TaughtMove& move : taught) sequences.moves.push_back({move.poses, move.span_s});
  return std::make_unique<PoseSequenceRecogniser>(std::move(sequences));
}

}  // namespace etude
