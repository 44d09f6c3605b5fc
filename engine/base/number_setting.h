#pragma once

#include <string>

namespace etude {

/// A number that one method can be set by, as scenario files name it; `Settings` is the struct that holds it.
template <typename Settings>
struct NumberSetting {
  std::string key;
  double Settings::*member = nullptr;
  double lowest = 0, largest = 0;  ///< both allowed
  std::string meaning;             ///< one sentence, for people
};

}  // namespace etude
