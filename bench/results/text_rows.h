#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/model/run_data.h"
#include "bench/results/folder.h"

namespace etude {

/// Opens the rows of a run that are lines of text, so that they are read one at a time: only the places of the lines
/// are held in memory. Every line is decoded once; fails with file:line if one of them is not as DecodeRow allows, or a
/// line of curves or times is not as a run writes it. Curves and times of unknown cells are left out, as are all but
/// the first of a cell. A line that changes later is read as an empty row.
Result<std::shared_ptr<const RowSource>> OpenTextRows(const std::filesystem::path& folder,
                                                      const std::vector<std::string>& scenarios);

}  // namespace etude
