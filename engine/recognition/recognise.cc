#include "engine/recognition/recognise.h"

#include <algorithm>
#include <cmath>

#include "engine/recognition/pose_vector.h"

namespace etude {
namespace {

Result<void> CheckAsked(std::span<const AskedMove> asked, std::size_t moves, std::size_t frames) {
  int free_from = 0;
  for (const auto& [move, window] : asked) {
    const auto [begin, end] = window;
    if (move >= moves)
      return Fail({}, "move number {} is requested, but only {} moves were taught; moves are counted from 0", move,
                  moves);
    if (begin < 0 || end < begin || end > static_cast<int>(frames)) {
      return Fail({}, "a move is requested in frames {} to {}, but the stream has {} frames", begin, end, frames);
    }
    if (begin < free_from) {
      return Fail({}, "a move is requested from frame {} on, but the previous request lasts until frame {}", begin,
                  free_from);
    }
    free_from = end;
  }
  return {};
}

}  // namespace

FrameInterval FramesBetween(double start_s, double end_s, const SkeletonStream& stream) {
  const int count = static_cast<int>(stream.frames.size());
  const int begin = std::clamp(static_cast<int>(std::floor(start_s * stream.rate_hz)), 0, count);
  const int end = std::clamp(static_cast<int>(std::ceil(end_s * stream.rate_hz)), begin, count);
  return {begin, end};
}

Result<EvidenceTrace> FollowStream(const Recogniser& recogniser, std::size_t moves, const SeenStream& seen,
                                   std::span<const AskedMove> asked) {
  RETURN_IF_ERROR(CheckAsked(asked, moves, seen.frames.size()));
  EvidenceTrace trace{.moves = moves, .asked = {}, .spotted = {}};
  trace.asked.reserve(seen.frames.size());
  trace.spotted.reserve(seen.frames.size() * moves);
  const auto follower = recogniser.Follow(seen.filtered.rate_hz);
  const AskedMove* next = asked.data();
  const AskedMove* const end = next + asked.size();
  // Open and close the windows at their frames, and record the evidence of every frame.
  for (std::size_t t = 0; t < seen.frames.size(); ++t) {
    const int now = static_cast<int>(t);
    if (next != asked.data() && (next - 1)->window.end == now) follower->Ask(std::nullopt);
    for (; next != end && next->window.begin == now; ++next) {
      if (next->window.end > now) follower->Ask(next->move);
    }
    const Evidence evidence = follower->Update(seen[t]);
    trace.asked.push_back(evidence.asked);
    trace.spotted.insert(trace.spotted.end(), evidence.spotted.begin(), evidence.spotted.end());
  }
  return trace;
}

Judgement JudgeWindow(const EvidenceTrace& trace, const FrameInterval& window, double threshold) {
  const auto frames = std::span(trace.asked).subspan(window.begin, window.end - window.begin);
  Judgement judgement{.recognised_at = {}, .score = 0, .running_score = {frames.begin(), frames.end()}};
  if (frames.empty()) return judgement;
  judgement.score = frames.back();
  const auto reached = std::ranges::find_if(frames, [&](double evidence) { return evidence >= threshold; });
  if (reached != frames.end()) judgement.recognised_at = static_cast<int>(reached - frames.begin());
  return judgement;
}

MoveSpotter::MoveSpotter(std::size_t moves, const DecisionOptions& options, double rate_hz)
    : threshold_(options.threshold),
      refractory_frames_(static_cast<int>(std::lround(options.refractory_s * rate_hz))),
      step_frames_(static_cast<int>(std::ceil(rate_hz / kStepsPerSecond))),
      states_(moves) {}

std::span<const std::size_t> MoveSpotter::Update(std::span<const double> spotted, bool body_seen) {
  fired_.clear();
  // Recognisers that compare steps renew their evidence when the first step with a body ends.
  if (!body_seen) renewed_at_ = frame_ + step_frames_;
  const bool is_renewed = body_seen && frame_ >= renewed_at_;
  for (std::size_t move = 0; move < states_.size() && is_renewed; ++move) {
    State& state = states_[move];
    const bool is_above = spotted[move] >= threshold_;
    if (is_above && !state.is_above && frame_ >= state.silent_until) {
      fired_.push_back(move);
      state.silent_until = frame_ + refractory_frames_;
    }
    state.is_above = is_above;
  }
  ++frame_;
  return fired_;
}

std::vector<Detection> FindMoves(const EvidenceTrace& trace, double rate_hz, const DecisionOptions& options) {
  MoveSpotter spotter(trace.moves, options, rate_hz);
  std::vector<Detection> found;
  for (std::size_t t = 0; t < trace.asked.size(); ++t) {
    for (std::size_t move : spotter.Update(trace.SpottedAt(t))) found.push_back({move, static_cast<int>(t)});
  }
  std::ranges::stable_sort(found, {}, &Detection::move);
  return found;
}

}  // namespace etude
