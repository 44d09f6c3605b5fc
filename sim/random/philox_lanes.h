#pragma once

#include <cstddef>
#include <cstdint>

namespace etude {

/// Writes blocks of Philox 4×64-10 with the counters `first`, `first` + 1, … and the key (key0, key1): four numbers
/// each, at most `count` blocks. Returns the number of written blocks, which is 0 on processors without eight lanes of
/// 64 bits, where Random123's own code is as fast.
std::size_t FillPhiloxBlocks(std::uint64_t first, std::uint64_t key0, std::uint64_t key1, std::size_t count,
                             std::uint64_t* out);

}  // namespace etude
