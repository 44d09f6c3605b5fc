#include "bench/files/save_json.h"

#include "bench/files/files.h"

namespace etude {

Result<void> SaveJson(const std::filesystem::path& path, const Json& json) {
  ASSIGN_OR_RETURN(const auto text, WriteJson(json));
  return WriteFileAtomically(path, text + "\n");
}

}  // namespace etude
