#include "engine/transitions/choices/planning.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "engine/transitions/library/transition_points.h"

namespace etude {

AllowedFrames AllowedBridgeFrames(const MotionLibrary& library, const TransitionRequest& request) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  return {.leave = BridgeFramesWithin(playing, WaitWindow(playing, request.request_frame, request.budget_s)),
          .enter = BridgeFramesWithin(next, EntryWindow(next))};
}

AllowedFrames AllowedAnyFrames(const MotionLibrary& library, const TransitionRequest& request, double least_play_s) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int frames = next.FrameCount();
  const int least_left = std::max(static_cast<int>(std::ceil(least_play_s * next.rate_hz - 1e-9)), 1);
  const int enter_end = std::max(frames - least_left, std::max(frames / 2, 1));
  return {.leave = FramesWithin(WaitWindow(playing, request.request_frame, request.budget_s)),
          .enter = FramesWithin({0, enter_end - 1})};
}

AllowedFrames AllowedEarlyFrames(const MotionLibrary& library, const TransitionRequest& request,
                                 double most_skipped_s) {
  const TaggedClip &playing = library.tagged[request.from], &next = library.tagged[request.to];
  const int skipped = std::min(static_cast<int>(most_skipped_s * next.rate_hz + 1e-9), next.FrameCount() / 3);
  return {.leave = FramesWithin(WaitWindow(playing, request.request_frame, request.budget_s)),
          .enter = FramesWithin({0, std::min(skipped, next.FrameCount() - 2)})};
}

TransitionRecord DirectTransition(const MotionLibrary& library, const TransitionRequest& request, int leave_frame,
                                  int enter_frame, const MatchRules& rules) {
  const TaggedClip &from = library.tagged[request.from], &to = library.tagged[request.to];
  TransitionRecord record;
  record.branch = to.InFrontHalf(enter_frame) ? Branch::kFrontHalf : Branch::kRearHalf;
  record.request_frame = request.request_frame;
  record.segments = {{.clip = request.from, .first = request.request_frame, .last = leave_frame, .own = {}},
                     {.clip = request.to, .first = enter_frame, .last = to.FrameCount() - 1, .own = {}}};
  record.distances = {ComputeDistance(from.grades[leave_frame], to.grades[enter_frame], rules.weights)};
  record.wait_s = WaitOf(record.segments, from.rate_hz);
  return record;
}

std::vector<Candidate> ListCandidates(const MotionLibrary& library, const TransitionRequest& request,
                                      const MatchRules& rules, const RankedPair& taken, std::vector<RankedPair> others,
                                      CandidateOutcome passed_over) {
  // Keep the best of the pairs that were not taken.
  std::sort(others.begin(), others.end(), [](const RankedPair& a, const RankedPair& b) {
    return std::tuple(!a.matches, a.rank, a.from, a.to) < std::tuple(!b.matches, b.rank, b.from, b.to);
  });
  others.resize(std::min(others.size(), kMaxCandidates - 1));
  // List the taken pair and the kept pairs, in order of their frames.
  std::vector<Candidate> candidates;
  const auto add = [&](const RankedPair& pair, CandidateOutcome outcome) {
    const Grades &from = library.tagged[request.from].grades[pair.from],
                 &to = library.tagged[request.to].grades[pair.to];
    candidates.push_back({.from_frame = pair.from,
                          .to_frame = pair.to,
                          .distance = ComputeDistance(from, to, rules.weights),
                          .cost = pair.cost,
                          .outcome = outcome});
  };
  add(taken, CandidateOutcome::kTaken);
  for (const RankedPair& pair : others) add(pair, pair.matches ? passed_over : CandidateOutcome::kTooFar);
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tuple(a.from_frame, a.to_frame) < std::tuple(b.from_frame, b.to_frame);
  });
  return candidates;
}

std::string DescribeNoMatch(const std::vector<RankedPair>& nearest, std::int64_t pairs, std::string_view frames,
                            const MatchRules& rules) {
  if (nearest.empty()) return fmt::format("none of the {} pairs of {} has the same tags in both frames", pairs, frames);
  const double least = std::ranges::min_element(nearest, {}, &RankedPair::rank)->rank;
  return fmt::format("no match among {} pairs of {}: the smallest distance is d = {:.2f}, which is not below {:g}",
                     pairs, frames, least, rules.threshold);
}

std::string DescribePair(const MotionLibrary& library, const TransitionRequest& request, int from, int to) {
  const double wait_s = (from - request.request_frame) / library.tagged[request.from].rate_hz;
  return fmt::format("{} frame {} ({:.2f} s after the request) and {} frame {}", library.names[request.from], from,
                     wait_s, library.names[request.to], to);
}

namespace {

std::vector<Grades> GradesOf(const TaggedClip& clip, std::span<const int> frames) {
  std::vector<Grades> grades;
  for (int frame : frames) grades.push_back(clip.grades[frame]);
  return grades;
}

}  // namespace

FuzzyGate::FuzzyGate(const TaggedClip& playing, const TaggedClip& next, std::vector<int> entering,
                     const MatchRules& rules)
    : playing_(playing),
      next_(next),
      entering_(std::move(entering)),
      rules_(rules),
      rows_(GradesOf(next, entering_), rules.weights),
      distances_(entering_.size()) {}

std::span<const FuzzyGate::Compared> FuzzyGate::Compare(int from) {
  rows_.Compute(playing_.grades[from], distances_);
  compared_.clear();
  for (std::size_t i = 0; i < entering_.size(); ++i) {
    if (rules_.within_class && playing_.tags[from] != next_.tags[entering_[i]]) continue;
    compared_.push_back({entering_[i], distances_[i], distances_[i] < rules_.threshold});
  }
  return compared_;
}

}  // namespace etude
