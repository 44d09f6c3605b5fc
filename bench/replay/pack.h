#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "bench/model/row.h"
#include "bench/run/setup.h"
#include "io/files/json.h"

namespace etude {

/// A cell that was packed: all that is needed to run it again, and what came of it.
struct Pack {
  SuiteSetup suite;  ///< of one scenario
  Row row;
  JsonPtr motions;  ///< the clips and recordings, with their bytes
};

/// Reads what PackCell wrote; `file` names it in complaints.
Result<Pack> ReadPack(std::string_view bytes, const std::string& file);

/// Writes the clips and recordings of a pack below `folder`, and has its scenario take them from there.
Result<void> UnpackMotions(Pack& pack, const std::string& file, const std::filesystem::path& folder);

}  // namespace etude
