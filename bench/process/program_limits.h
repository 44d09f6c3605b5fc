#pragma once

#include <cstddef>
#include <cstdint>

namespace etude {

/// What a program that is not ours may take, beside the time and memory that a scenario allows it.
struct ProgramLimits {
  static constexpr std::uint64_t kFileBytes = std::uint64_t{256} << 20;  ///< of a file; in a fence, of a scratch folder
  static constexpr std::uint64_t kOpenFiles = 4096;
  static constexpr std::uint64_t kThreads = 4096;  ///< of all its processes; in a fence, and not for root
  static constexpr std::size_t kProcesses = 256;   ///< looked at 50 times a second
};

}  // namespace etude
