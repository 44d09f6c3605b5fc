#include "io/clips/assimp/span.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/clips/fbx_preparation.h"

namespace etude {
namespace {

/// Calls `use` with each array of keys of an animation, and with the number of its keys.
template <typename Use>
void ForEachTrack(aiAnimation& animation, Use use) {
  for (unsigned i = 0; i < animation.mNumChannels; ++i) {
    aiNodeAnim& moved = *animation.mChannels[i];
    use(moved.mPositionKeys, moved.mNumPositionKeys);
    use(moved.mRotationKeys, moved.mNumRotationKeys);
    use(moved.mScalingKeys, moved.mNumScalingKeys);
  }
}

/// Keeps the keys between two times. If more than `gap` lies between an end and the nearest key that is kept, the next
/// key outside moves to this end, with the interpolated value.
template <typename Key>
void CutTrack(Key* keys, unsigned& count, double begin, double end, double gap) {
  const auto mix = [](const auto& a, const auto& b, ai_real share) { return Mixed(a, b, share); };
  const auto is_early = [&](const Key& key) { return key.mTime < begin; };
  const auto is_in_time = [&](const Key& key) { return key.mTime <= end; };
  auto first = static_cast<unsigned>(std::partition_point(keys, keys + count, is_early) - keys);
  auto last = static_cast<unsigned>(std::partition_point(keys + first, keys + count, is_in_time) - keys);
  const bool needs_begin = first > 0 && (first == last || keys[first].mTime - begin > gap);
  const bool needs_end = last < count && (first == last || end - keys[last - 1].mTime > gap);
  auto at_begin = needs_begin ? ValueAt(keys, count, begin, mix) : decltype(keys->mValue){};
  auto at_end = needs_end ? ValueAt(keys, count, end, mix) : decltype(keys->mValue){};
  if (needs_begin) keys[--first] = Key(begin, at_begin);
  if (needs_end) keys[last++] = Key(end, at_end);
  std::move(keys + first, keys + last, keys);
  count = last - first;
}

}  // namespace

void CutToSpan(aiAnimation& animation, FbxKeyFacts& facts) {
  const double rate = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1;
  const double lasts_s = animation.mDuration / rate;
  const bool is_wide = lasts_s > 1.5 * kFbxMarginS;  // a span that the file does not state fully stays narrow
  // Count in seconds from the beginning of the span. A track with one key is constant, so its time tells nothing.
  double first_s = std::numeric_limits<double>::infinity(), last_s = -first_s;
  const auto see = [&](auto* keys, unsigned count) {
    for (unsigned k = 0; k < count; ++k) keys[k].mTime = keys[k].mTime / rate - (is_wide ? kFbxMarginS : 0);
    if (count < 2) return;
    first_s = std::min(first_s, keys[0].mTime);
    last_s = std::max(last_s, keys[count - 1].mTime);
  };
  ForEachTrack(animation, see);
  animation.mTicksPerSecond = 1;
  if (first_s > last_s) {
    ForEachTrack(animation, [](auto* keys, unsigned count) {
      for (unsigned k = 0; k < count; ++k) keys[k].mTime = 0;
    });
    return;
  }
  // Find the span. Rounded times may lie a little outside.
  constexpr double kRounding_s = 1e-6;
  const double span_s = is_wide ? lasts_s - 2 * kFbxMarginS : std::numeric_limits<double>::infinity();
  const bool has_span = span_s > kRounding_s, is_empty = last_s <= 0 || first_s >= span_s;
  if (has_span && is_empty) ++facts.empty_spans;
  const double frame_s = 1 / rate, gap_s = 1.5 * frame_s;
  double begin_s = -kRounding_s, end_s = span_s + kRounding_s, shift_s = 0;
  if (!has_span || is_empty) {
    shift_s = begin_s = first_s;
    end_s = last_s;
  }
  // One frame outside is common, and not worth a remark.
  if (const double cut_s = std::max(begin_s - first_s, last_s - end_s); cut_s > gap_s) {
    facts.cut_s = std::max(facts.cut_s, cut_s);
  }
  ForEachTrack(animation, [&](auto* keys, unsigned& count) {
    if (count == 1) keys[0].mTime = std::clamp(keys[0].mTime, begin_s, std::max(begin_s, end_s));
    if (count > 1) CutTrack(keys, count, begin_s, end_s, gap_s);
    for (unsigned k = 0; k < count; ++k) keys[k].mTime = std::max(0.0, keys[k].mTime - shift_s);
  });
}

}  // namespace etude
