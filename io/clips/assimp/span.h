#pragma once

#include <assimp/anim.h>

#include <algorithm>

#include "io/clips/fbx.h"

namespace etude {

/// Interpolates the keys of a channel at a time: `mix(from, to, share)` blends the two neighbouring keys. Before the
/// first key and after the last one, the value is constant.
template <typename Key, typename Mix>
auto ValueAt(const Key* keys, unsigned count, double time, Mix mix) {
  const auto is_before = [](const Key& key, double at) { return key.mTime < at; };
  const auto to = static_cast<unsigned>(std::lower_bound(keys, keys + count, time, is_before) - keys);
  if (to == 0 || to == count) return keys[to == 0 ? 0 : count - 1].mValue;
  const Key &a = keys[to - 1], &b = keys[to];
  return mix(a.mValue, b.mValue, static_cast<ai_real>((time - a.mTime) / (b.mTime - a.mTime)));
}

/// Blends two keys: a straight line, and the shortest arc at a constant speed.
inline aiVector3D Mixed(const aiVector3D& a, const aiVector3D& b, ai_real share) { return a + share * (b - a); }
inline aiQuaternion Mixed(const aiQuaternion& a, const aiQuaternion& b, ai_real share) {
  aiQuaternion between;
  aiQuaternion::Interpolate(between, a, b, share);
  return between;
}

/// Sets the times of an animation, whose time span PrepareTakes widened, to seconds from the beginning of the span the
/// file states, and takes out keys outside of this span. If the file states no span, or if its span contains no key,
/// the times begin at the first key, and all keys stay. An animation whose span is not widened loses the keys before
/// time 0.
void CutToSpan(aiAnimation& animation, FbxKeyFacts& facts);

}  // namespace etude
