#include "engine/teaching/watch.h"

#include <algorithm>

namespace etude {

StreamWatcher::StreamWatcher(const Recogniser& recogniser, std::size_t moves, const WatchOptions& options,
                             double rate_hz)
    : sight_(options.filter, rate_hz),
      follower_(recogniser.Follow(rate_hz)),
      spotter_(moves, options.decision, rate_hz) {}

std::vector<Spotting> StreamWatcher::Take(const SensedFrame& frame) {
  const Evidence evidence = follower_->Update(sight_.Update(frame));
  std::vector<Spotting> spottings;
  for (const std::size_t move : spotter_.Update(evidence.spotted, frame.body_seen)) {
    spottings.push_back({move, frame_, evidence.spotted[move]});
  }
  ++frame_;
  return spottings;
}

std::vector<Spotting> Watch(const SkeletonStream& stream, const Recogniser& recogniser, std::size_t moves,
                            const WatchOptions& options) {
  StreamWatcher watcher(recogniser, moves, options, stream.rate_hz);
  std::vector<Spotting> all;
  for (const SensedFrame& frame : stream.frames) {
    const std::vector<Spotting> spottings = watcher.Take(frame);
    all.insert(all.end(), spottings.begin(), spottings.end());
  }
  return all;
}

std::optional<std::size_t> Classify(const SeenStream& seen, int begin, int end, const Recogniser& recogniser,
                                    std::size_t moves) {
  const auto follower = recogniser.Follow(seen.filtered.rate_hz);
  std::vector<double> best(moves, 0.0);
  for (int t = begin; t < end; ++t) {
    const Evidence evidence = follower->Update(seen[static_cast<std::size_t>(t)]);
    for (std::size_t m = 0; m < moves; ++m) best[m] = std::max(best[m], evidence.spotted[m]);
  }
  if (const auto whole = follower->Whole()) return whole;
  const auto highest = std::ranges::max_element(best);
  if (highest == best.end() || *highest <= 0) return std::nullopt;
  return static_cast<std::size_t>(highest - best.begin());
}

double JudgeAsked(const SeenStream& seen, int begin, int end, const Recogniser& recogniser, std::size_t move) {
  const auto follower = recogniser.Follow(seen.filtered.rate_hz);
  follower->Ask(move);
  double asked = 0;
  for (int t = begin; t < end; ++t) asked = follower->Update(seen[static_cast<std::size_t>(t)]).asked;
  return asked;
}

}  // namespace etude
