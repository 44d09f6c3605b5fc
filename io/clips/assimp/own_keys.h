#pragma once

#include <assimp/anim.h>

#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/clips/fbx.h"

namespace etude {

/// Properties of an FBX file that are read from its own curves.
struct FbxOwnKeys {
  /// The times of all keys of a joint in a clip, by the names of clip and joint; "" for all joints of the clip.
  /// Ascending seconds from the beginning of the animation as assimp counts them.
  std::map<std::pair<std::string, std::string>, std::vector<double>> times_s;
  std::set<std::string> limbs;  ///< the names of the models that are joints of a skeleton (LimbNode)
};

/// Reads the curves of an FBX file, prepared by PrepareTakes, and sets those of `facts` that depend on single curves:
/// `longest_s`, `step_s` and `turn_deg`.
FbxOwnKeys ReadOwnKeys(std::string_view bytes, FbxKeyFacts& facts);

/// Takes out the keys that assimp inserts where an Euler angle changes by 180° or more between two keys of the file, if
/// these keys are near (kFbxNearKeys_s). In this way every branch of the Euler angles gives the same motion: joints
/// turn along the shortest arc. Between keys that are farther apart, the inserted keys keep whole turns.
void TakeOutInserted(aiAnimation& animation, const FbxOwnKeys& own);

}  // namespace etude
