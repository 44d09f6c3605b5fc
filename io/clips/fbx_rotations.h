#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etude {

/// Sets PreRotation, PostRotation and RotationOrder to 0 in models of an FBX file (version 7, binary or text) whose
/// RotationActive is 0, because the FBX SDK then ignores all three and assimp does not. A model without RotationActive
/// has that of the file's template of models, else 0. Returns the number of models that this changes; `changed` has the
/// new bytes if there are any. If a record ends beyond the file, everything after it stays unchanged.
std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed);

}  // namespace etude
