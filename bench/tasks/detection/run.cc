#include "bench/tasks/detection/run.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "bench/tasks/sensing/camera_stream.h"
#include "engine/teaching/labelled_streams.h"
#include "engine/teaching/watch.h"

namespace etude {
namespace {

SeenStream PartOf(const SeenStream& seen, const FrameInterval& frames) {
  return {.filtered = PartOf(seen.filtered, frames.begin, frames.end),
          .frames = {seen.frames.begin() + frames.begin, seen.frames.begin() + frames.end}};
}

/// Returns the move with the most evidence in any frame of the window. If several moves have the most, returns the
/// first.
std::optional<std::size_t> MoveNamedIn(const FrameInterval& window, const EvidenceTrace& trace) {
  std::optional<std::size_t> named;
  double most = 0;
  for (int frame = window.begin; frame < window.end; ++frame) {
    const auto spotted = trace.SpottedAt(static_cast<std::size_t>(frame));
    for (std::size_t move = 0; move < spotted.size(); ++move) {
      if (spotted[move] > most || (spotted[move] == most && named && move < *named)) {
        most = spotted[move];
        named = move;
      }
    }
  }
  return named;
}

/// Returns the move recognised in a performance. In a labelled recording, the performance is cut out and classified as
/// a whole, as in the papers on labelled data sets. In a session, the evidence within the window decides.
std::optional<std::size_t> NameOf(const DetectionEvent& event, const DetectionWorld& world, const SeenStream& seen,
                                  const Repertoire& repertoire, const Recogniser& recogniser,
                                  const FrameInterval& window, const EvidenceTrace& trace) {
  if (!world.IsRecorded()) return MoveNamedIn(window, trace);
  return Classify(seen, event.performed.begin, event.performed.end, recogniser, repertoire.taught.size());
}

}  // namespace

SeenStream SeeSession(const DetectionWorld& world, const DetectionMethod& method) {
  if (world.cameras != nullptr && !method.sees_truth) {
    const Result<SkeletonStream>& captured = world.cameras->See(method.Capture());
    return SeeStream(captured ? *captured : world.stream, method.filter);
  }
  const SkeletonStream& stream = method.sees_truth ? StreamOf(world.motion) : world.stream;
  const std::vector<FrameInterval> takes = world.Takes();
  if (takes.size() == 1) return SeeStream(stream, method.filter);
  SeenStream all{.filtered = {.rate_hz = stream.rate_hz, .frames = {}}, .frames = {}};
  for (const auto& [begin, end] : takes) {
    const SeenStream seen = SeeStream(PartOf(stream, begin, end), method.filter);
    all.filtered.frames.insert(all.filtered.frames.end(), seen.filtered.frames.begin(), seen.filtered.frames.end());
    all.frames.insert(all.frames.end(), seen.frames.begin(), seen.frames.end());
  }
  return all;
}

std::vector<EvidenceTrace> FollowSession(const DetectionWorld& world, const SeenStream& seen,
                                         const Repertoire& repertoire, const Recogniser& recogniser) {
  std::vector<EvidenceTrace> traces;
  for (const auto& [begin, end] : world.Takes()) {
    std::vector<AskedMove> asked;
    for (const DetectionEvent& event : world.events) {
      const auto move = repertoire.TaughtIndexOf(event.move);
      const bool is_here = event.window.begin >= begin && event.window.end <= end;
      if (move && is_here) asked.push_back({*move, {event.window.begin - begin, event.window.end - begin}});
    }
    auto trace = FollowStream(recogniser, repertoire.taught.size(), PartOf(seen, {begin, end}), asked);
    assert(trace);  // every window is within one recording
    traces.push_back(*std::move(trace));
  }
  return traces;
}

std::vector<Judgement> JudgeEvents(const DetectionWorld& world, std::span<const EvidenceTrace> traces,
                                   double threshold) {
  const std::vector<FrameInterval> takes = world.Takes();
  std::vector<Judgement> judgements;
  auto event = world.events.begin();
  for (std::size_t t = 0; t < takes.size(); ++t) {
    const auto [begin, end] = takes[t];
    for (; event != world.events.end() && event->window.end <= end; ++event) {
      judgements.push_back(JudgeWindow(traces[t], {event->window.begin - begin, event->window.end - begin}, threshold));
    }
  }
  return judgements;
}

SessionVerdict JudgeSession(const DetectionWorld& world, const SeenStream& seen, const Repertoire& repertoire,
                            const Recogniser& recogniser, const MethodDecision& decision) {
  const std::vector<EvidenceTrace> traces = FollowSession(world, seen, repertoire, recogniser);
  const std::vector<FrameInterval> takes = world.Takes();
  SessionVerdict verdict{
      .filtered = seen.filtered, .events = JudgeEvents(world, traces, decision.judging), .alarms = {}};
  verdict.threshold = decision.judging;
  auto event = world.events.begin();
  for (std::size_t t = 0; t < takes.size(); ++t) {
    const auto [begin, end] = takes[t];
    for (; event != world.events.end() && event->window.end <= end; ++event) {
      const FrameInterval window{event->window.begin - begin, event->window.end - begin};
      verdict.named.push_back(NameOf(*event, world, seen, repertoire, recogniser, window, traces[t]));
    }
    for (const Detection& detection : FindMoves(traces[t], seen.filtered.rate_hz, decision.spotting)) {
      verdict.spotted.push_back({detection.move, begin + detection.frame});
    }
  }
  std::ranges::stable_sort(verdict.spotted, {}, &Detection::move);
  std::ranges::copy_if(verdict.spotted, std::back_inserter(verdict.alarms), [&](const Detection& detection) {
    return !IsPerformance(repertoire.taught[detection.move].name, detection.frame, world);
  });
  return verdict;
}

}  // namespace etude
