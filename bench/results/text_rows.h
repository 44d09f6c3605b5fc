#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/results/folder.h"

namespace etude {

/// Opens the rows of a run that are stored as lines of text. Only the positions of the lines are held in memory; the
/// source reads one row at a time. This function decodes every line once. It fails, with file:line, if DecodeRow
/// refuses a line, or if a line of curves or times cannot be decoded. Curves and times of cells without a row are
/// ignored. If a cell has several lines of curves, the first counts; of several lines of times, the last. If a row's
/// line is changed after this function has read it, and can no longer be decoded, the source returns an empty row.
Result<std::shared_ptr<const RowSource>> OpenTextRows(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& scenarios);

}  // namespace etude
