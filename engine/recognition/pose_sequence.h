#pragma once

#include <deque>
#include <span>
#include <vector>

namespace etude {

/// How well a stream passes through the poses of a move in their order, each held for a while. A passage is a choice of
/// frames in order, one per pose; it fits as well as its worst pose, and a pose as its worst of the last `hold_frames`
/// seen frames.
class PoseSequence {
 public:
  /// At least one pose; `hold_frames` ≥ 1. `span_frames` ≥ 0: from the first pose to the last at most so many frames.
  PoseSequence(std::size_t poses, int hold_frames, int span_frames);

  /// Passages begin anew for `Asked`.
  void Open();
  /// How well this frame matches each pose, in [0, 1]. Nothing: no body is seen, which neither breaks nor holds a pose.
  void Update(std::span<const double> matches);

  /// Of the best passage since `Open`, however long; never falls until the next.
  double Asked() const { return asked_.back(); }
  /// Of the best passage within the span that ends in this frame.
  double Spotted() const { return spotted_; }

 private:
  struct Held {
    int frame;
    std::vector<double> scores;  // per pose
  };

  double BestPassageEndingIn(std::span<const double> held) const;

  std::size_t hold_frames_;
  int span_frames_;
  int frame_ = 0;
  std::size_t seen_ = 0, seen_since_open_ = 0;
  std::vector<std::vector<double>> recent_;  // per pose, the last `hold_frames` matches, a ring
  std::vector<double> asked_;                // per pose, of passages that got so far
  std::deque<Held> within_span_;             // before this frame
  double spotted_ = 0;
};

}  // namespace etude
