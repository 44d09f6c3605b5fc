#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etude {

/// Sets PreRotation, PostRotation and RotationOrder to 0 in models of an FBX file (version 7, binary or text) whose own
/// RotationActive is 0, because the FBX SDK then ignores all three and assimp does not. Returns the number of models
/// that this changes; `changed` receives the new bytes if there are any. Models without RotationActive stay as they
/// are; so does everything after a record that ends beyond the file.
std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed);

}  // namespace etude
