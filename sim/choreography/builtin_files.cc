#include "sim/choreography/builtin_files.h"

#include <algorithm>

namespace etude {
namespace {

std::string_view NameOf(const EmbeddedText& file) { return file.name.substr(0, file.name.rfind('.')); }

}  // namespace

std::vector<std::string> NamesOf(std::span<const EmbeddedText> files) {
  std::vector<std::string> names;
  for (const EmbeddedText& file : files) names.emplace_back(NameOf(file));
  return names;
}

const EmbeddedText* FindFile(std::span<const EmbeddedText> files, std::string_view name) {
  const auto found = std::ranges::find(files, name, NameOf);
  return found != files.end() ? &*found : nullptr;
}

}  // namespace etude
