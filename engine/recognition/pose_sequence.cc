#include "engine/recognition/pose_sequence.h"

#include <algorithm>
#include <cassert>

namespace etude {

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
  spotted_ = 0;
  if (matches.empty()) return;
  const std::size_t slot = seen_++ % hold_frames_;
  ++seen_since_open_;

  std::vector<double> held;
  for (std::size_t k = 0; k < recent_.size(); ++k) {
    recent_[k][slot] = matches[k];
    held.push_back(*std::ranges::min_element(recent_[k]));
  }
  // From the last pose to the first: each reads its predecessor's state of the previous frame, not of this one.
  for (std::size_t k = held.size(); k-- > 0 && seen_since_open_ >= hold_frames_;) {
    asked_[k] = std::max(asked_[k], std::min(held[k], k == 0 ? 1.0 : asked_[k - 1]));
  }
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

}  // namespace etude
