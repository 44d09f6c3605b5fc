#include "engine/formats/unique_names.h"

#include <fmt/format.h>

namespace etude {

std::string UniqueNames::Add(const std::string& name) {
  std::string unique = name;
  for (int number = 2; !given_.insert(unique).second; ++number) unique = fmt::format("{}#{}", name, number);
  return unique;
}

}  // namespace etude
