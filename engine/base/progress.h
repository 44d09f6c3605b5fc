#pragma once

#include <cstddef>
#include <functional>

namespace etude {

/// Is called with how much of some work is done, of how much. An empty function is not called.
using OnProgress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace etude
