#pragma once

#include <string>
#include <string_view>

#include "engine/base/result.h"
#include "engine/transitions/tags_file/bridge_tags.h"

namespace etude {

/// Larger files are refused before memory is taken.
constexpr std::size_t kLargestTagsFile = 512'000'000;

/// The tags as XML of docs/schemas/bridge-tags.xsd: the same bytes for the same tags, numbers with the fewest digits
/// that read back the same. Refused: names that XML cannot hold (bytes that are no UTF-8, control characters).
Result<std::string> WriteTagsFile(const BridgeTags& tags);

/// Reads what WriteTagsFile writes, to the last bit; `file` is what complaints call it. Everything is held against the
/// schema, and against itself: frames lie within their clips and rise, times and tags follow from frames and grades,
/// clips have names of their own, keys are bridge frames. A document type declaration is refused: nothing is loaded
/// or expanded.
Result<BridgeTags> ReadTagsFile(std::string_view text, const std::string& file);

}  // namespace etude
