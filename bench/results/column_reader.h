#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "bench/model/row_source.h"
#include "engine/base/result.h"

namespace etude {

/// Opens the columns of a run; rows, in canonical order, are made of them one at a time. Fails, naming the file, when
/// one is missing, or leads out of what is there.
Result<std::shared_ptr<const RowSource>> OpenColumns(const std::filesystem::path& folder,
                                                     const std::vector<std::string>& scenarios);

}  // namespace etude
