#pragma once

#include <cstddef>
#include <cstdint>

namespace etude {

/// Writes blocks of Philox 4×64-10 with the counters `first`, `first` + 1, … and the key (key0, key1): a block has four
/// numbers, and at most `count` blocks are written. Returns the number of written blocks, which is 0 on processors
/// without eight lanes of 64 bits, because Random123's own code is as fast there.
std::size_t FillPhiloxBlocks(std::uint64_t first, std::uint64_t key0, std::uint64_t key1, std::size_t count,
                             std::uint64_t* out);

/// The number of values below a range, and the number of values within it.
struct HalvesWithin {
  std::size_t below = 0, within = 0;
};
/// FindHalvesWithin writes whole vectors: at most this many numbers after the last result.
constexpr std::size_t kHalvesSlack = 64;
/// Splits each of `words` into two numbers of 32 bits, the low half first, and takes the first `count` numbers. Copies
/// those with values from `low` to `last`, both included, to `within`, in order; `within` needs room for `count` +
/// kHalvesSlack numbers.
HalvesWithin FindHalvesWithin(const std::uint64_t* words, std::size_t count, std::uint32_t low, std::uint32_t last,
                              std::uint32_t* within);

}  // namespace etude
