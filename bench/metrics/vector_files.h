#pragma once

#include <span>

#include "engine/base/embedded_text.h"

namespace etude {

/// bench/metrics/vectors/*.json, sorted by name (written by the build).
std::span<const EmbeddedText> MetricVectorFiles();

}  // namespace etude
