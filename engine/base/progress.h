#pragma once

#include <cstddef>
#include <functional>

namespace etude {

/// Told how much of some work is done, of how much; empty: nobody asks.
using OnProgress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace etude
