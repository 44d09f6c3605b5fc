#pragma once

#include <optional>
#include <span>
#include <vector>

#include "engine/bridging/links.h"
#include "engine/bridging/switch_record.h"

namespace etude {

struct MotionLibrary;

/// Paper A's in-between motion (補間動作): poses taken from bridge frames, and the tweening between any two of them, so
/// that any two clips connect.
struct InBetweenNet {
  /// A bridge frame that in-betweens are built of.
  struct Key {
    int clip = 0;
    int frame = 0;
  };
  std::vector<Key> keys;
};

/// The keys of a library's in-betweens.
InBetweenNet BuildInBetweens(std::span<const BodyMotion> motions, std::span<const TaggedClip> tagged);

/// A way through an in-between: out of the playing clip at a frame of `window`, and into clip `request.to`. Fills
/// branch, legs, meetings, candidates, counts and `why` of the record; returns whether there is one.
bool TakeInBetween(const MotionLibrary& library, const SwitchRequest& request, FrameWindow window,
                   const SwitchRules& rules, SwitchRecord& record);

}  // namespace etude
