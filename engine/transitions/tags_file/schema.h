#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// docs/schemas/bridge-tags.xsd, the only one (written by the build).
std::span<const EmbeddedText> TagsFileSchemas();

}  // namespace etude
