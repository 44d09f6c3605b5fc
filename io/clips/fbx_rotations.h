#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace etude {

/// Sets PreRotation, PostRotation and RotationOrder to 0 in every model whose RotationActive is 0. The FBX SDK ignores
/// the three properties of such a model, and assimp does not. `bytes` is an FBX file of version 7, binary or text. A
/// model without RotationActive inherits the value of the file's model template; without a template, the value is 0.
/// Returns the number of changed models; if this number is not 0, `changed` holds the new bytes. If a record ends
/// beyond the file, everything after this record stays unchanged.
std::size_t LeaveOutInactiveRotations(std::string_view bytes, std::string& changed);

}  // namespace etude
