#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etude {

/// Sets PreRotation, PostRotation and RotationOrder to 0 in models of an FBX file (version 7, binary or text) whose
/// RotationActive is 0, because the FBX SDK then ignores all three and assimp does not. A model without RotationActive
/// inherits the value of the file's model template; without a template, the value is 0. Returns the number of changed
/// models; if this number is not 0, `changed` holds the new bytes. If a record ends beyond the file, everything after
/// this record stays unchanged.
std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed);

}  // namespace etude
