#pragma once

#include <cstddef>
#include <functional>

namespace etude {

/// A callback that reports progress: `done` of `all` units of work. It may be empty.
using OnProgress = std::function<void(std::size_t done, std::size_t all)>;

}  // namespace etude
