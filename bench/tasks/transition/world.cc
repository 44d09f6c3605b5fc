#include "bench/tasks/transition/world.h"

namespace etude {
namespace {

bool IsLongEnough(const Stage& stage, int clip) { return stage.library.tagged[clip].FrameCount() >= kMinClipFrames; }

}  // namespace

int FromClip(const Stage& stage, const WorldKey& key) {
  return stage.playing[key.trial % static_cast<int>(stage.playing.size())];
}

Result<TransitionRequest> DrawRequest(const Stage& stage, const WorldKey& key) {
  constexpr int kEarliestRequest = 6;
  const int count = static_cast<int>(stage.library.names.size());
  if (count < 2) return Fail({}, "a transition needs two clips; this library has {}", count);
  TransitionRequest request{.from = FromClip(stage, key)};
  const int frames = stage.library.tagged[request.from].FrameCount();
  if (!IsLongEnough(stage, request.from)) {
    return Fail({}, "clip {} has {} frames; a transition is judged over at least {}", stage.library.names[request.from],
                frames, kMinClipFrames);
  }
  std::vector<int> others;
  for (int clip : stage.wanted) {
    if (clip != request.from && IsLongEnough(stage, clip)) others.push_back(clip);
  }
  if (others.empty()) return Fail({}, "no other clip of this library has at least {} frames", kMinClipFrames);
  // Draw the requested clip and the time of the request.
  request.to = others[RandomStream(key, "to-clip").IndexBelow(others.size())];
  // At least kEarliestRequest frames precede the request, and at least the clip's last frame follows it.
  const int last = frames - 2;
  RandomStream dice(key, "request-time");
  request.request_frame = kEarliestRequest + static_cast<int>(dice.IndexBelow(last - kEarliestRequest + 1));
  return request;
}

}  // namespace etude
