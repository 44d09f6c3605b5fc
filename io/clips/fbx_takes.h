#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace etude {

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
