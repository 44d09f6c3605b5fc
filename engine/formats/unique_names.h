#pragma once

#include <fmt/format.h>

#include <set>
#include <string>

namespace etude {

/// Gives every joint a name of its own: programs, and our own joint maps, tell joints by their names.
class UniqueNames {
 public:
  /// The name itself if it has not been given before, else the first free one of "<name>#2", "<name>#3", ….
  std::string Add(const std::string& name) {
    std::string unique = name;
    for (int number = 2; !given_.insert(unique).second; ++number) unique = fmt::format("{}#{}", name, number);
    return unique;
  }

 private:
  std::set<std::string> given_;
};

}  // namespace etude
