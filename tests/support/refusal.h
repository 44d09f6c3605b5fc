#pragma once

#include <etude/base.h>

#include <functional>
#include <string>

namespace etude::testing {

inline std::string RefusalOf(const std::function<void()>& act) {
  try {
    act();
  } catch (const engine::BadInput& error) {
    return error.what();
  }
  return "";
}

}  // namespace etude::testing
