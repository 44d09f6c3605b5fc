#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/results/folder.h"

namespace etude {

/// Opens the rows of a run that are stored as lines of text. Only the positions of the lines are held in memory; the
/// source reads one row at a time. This function decodes every line once. It fails, with file:line, if DecodeRow
/// refuses a line, or if a line of curves or times is not as a run writes it. Curves and times of unknown cells are
/// ignored, and so are second lines of a cell. A line that is changed later is read as an empty row.
Result<std::shared_ptr<const RowSource>> OpenTextRows(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& scenarios);

}  // namespace etude
