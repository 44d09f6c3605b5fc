#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

namespace etude {

/// Gives every joint a unique name, because other programs and our joint maps identify joints by their names.
class UniqueNames {
 public:
  /// Returns `name` if it has not been used yet, else the first unused one of "<name>#2", "<name>#3", ….
  std::string Add(const std::string& name) {
    std::string unique = name;
    for (int number = 2; !given_.insert(unique).second; ++number) unique = fmt::format("{}#{}", name, number);
    return unique;
  }

 private:
  std::set<std::string> given_;
};

}  // namespace etude
