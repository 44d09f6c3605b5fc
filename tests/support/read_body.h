#pragma once

#include <string>
#include <string_view>

#include "engine/formats/bvh.h"
#include "engine/retargeting/to_body.h"

namespace etude::testing {

/// Converts a clip to a body by the joints' names, with FindJointMap and ToBodyMotion.
inline Result<BodyConversion> ToBody(const Clip& clip, const std::string& file, const BodyOptions& options = {}) {
  ASSIGN_OR_RETURN(const auto map, FindJointMap(clip.skeleton, file));
  return ToBodyMotion(clip, map, file, options);
}

/// Reads a BVH file, and converts its clip with ToBody.
inline Result<BodyConversion> ReadBody(std::string_view bytes, const std::string& file) {
  ASSIGN_OR_RETURN(const auto clip, ReadBvh(bytes, file));
  return ToBody(clip, file);
}

}  // namespace etude::testing
