#include "reports/words/file_name.h"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>

namespace etude {

std::string FileNameOf(const std::string& scenario, std::size_t index) {
  std::string name = scenario;
  std::ranges::replace_if(
      name, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '_'; }, '_');
  return name == scenario ? name : fmt::format("{}-{}", name, index + 1);
}

}  // namespace etude
