#pragma once

#include <string>

#include "bench/model/run_data.h"

namespace etude {

/// Writes the page's verdicts as a short Markdown text, for a pull request or a closing note.
std::string WriteMarkdown(const RunData& run);

}  // namespace etude
