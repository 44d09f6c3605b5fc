#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bench/model/row.h"
#include "bench/run/setup.h"
#include "io/files/json.h"

namespace etude {

/// A packed cell: everything that is needed to run the cell again, and its result.
struct Pack {
  SuiteSetup suite;  ///< the set-up of one scenario
  Row row;
  JsonPtr motions;  ///< the clips and recordings with their content
};

/// Reads a file that PackCell wrote. `file` is its name in error messages.
Result<Pack> ReadPack(std::string_view bytes, const std::string& file);

/// Writes the clips and recordings of a pack into folders below `folder`, and makes the pack's scenario refer to them.
Result<void> UnpackMotions(Pack& pack, const std::string& file, const std::filesystem::path& folder);

}  // namespace etude
