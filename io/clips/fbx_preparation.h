#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace etude {

/// Sets PreRotation, PostRotation and RotationOrder to 0 in every model whose RotationActive is 0. The FBX SDK ignores
/// the three properties of such a model, and assimp does not. `bytes` is an FBX file of version 7, binary or text. A
/// model without RotationActive inherits the value of the file's model template; without a template, the value is 0.
/// Returns the number of changed models; if this number is not 0, `changed` holds the new bytes. If a record ends
/// beyond the file, everything after this record stays unchanged.
std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed);

/// Seconds by which PrepareTakes widens each time span on both sides.
inline constexpr double kFbxMarginS = 100'000;

/// Prepares the animations of an FBX file for assimp, which merges all animation layers, and which drops most keys
/// outside of an animation's time span but keeps others.
///
/// - Layers: layers that are muted or have weight 0 are taken out. Of the others, the first that moves joints stays,
///   together with layers of full weight that override it; the rest is taken out and reported.
/// - Time spans (LocalStart to LocalStop): each is wider by kFbxMarginS on both sides, so that assimp keeps all keys;
///   the span then follows from the animation's duration. If the file states only one end of a span, the span stays.
///
/// Returns the remarks. `changed` receives the new bytes, or "" if nothing changes.
std::vector<std::string> PrepareTakes(std::string_view bytes, std::string& changed);

/// Returns a doubt if joints do not inherit the scale of their parent (InheritType 2) and this scale is not 1, because
/// assimp lets them inherit it; "" without such joints.
std::string DoubtOfScales(std::string_view bytes);

}  // namespace etude
