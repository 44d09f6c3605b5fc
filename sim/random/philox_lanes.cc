// This file is compiled once for every vector instruction set of x86-64 CPUs; the best version is chosen at run time.
// All versions give the same bits, because the arithmetic uses integers.
#include "sim/random/philox_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sim/random/philox_lanes.cc"
#include "hwy/foreach_target.h"  // must come before highway.h

// This header must be included after foreach_target.h.
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace etude::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr size_t kLanes = 8;
using Word = hn::CappedTag<uint64_t, kLanes>;
using Vec = hn::Vec<Word>;

/// The high and the low 64 bits of the products of 64-bit numbers with one constant.
struct Product {
  Vec high, low;
};

HWY_INLINE Product Multiply(Vec a, uint64_t constant) {
  const Word word;
  const hn::Repartition<uint32_t, Word> half;
  // Multiply the 32-bit halves of the factors; index 0 is the low half, index 1 the high half.
  const auto mask = hn::Set(word, 0xffffffffu);
  const auto a0 = hn::BitCast(half, a), a1 = hn::BitCast(half, hn::ShiftRight<32>(a));
  const auto b0 = hn::BitCast(half, hn::Set(word, constant)), b1 = hn::BitCast(half, hn::Set(word, constant >> 32));
  const auto p00 = hn::MulEven(a0, b0), p01 = hn::MulEven(a0, b1), p10 = hn::MulEven(a1, b0), p11 = hn::MulEven(a1, b1);
  // Sum up the partial products, with carries.
  const auto middle = hn::Add(p10, hn::ShiftRight<32>(p00)), lower = hn::Add(p01, hn::And(middle, mask));
  return {hn::Add(hn::Add(p11, hn::ShiftRight<32>(middle)), hn::ShiftRight<32>(lower)),
          hn::Mul(a, hn::Set(word, constant))};
}

/// Philox counter blocks, one in every lane of the vector.
struct Blocks {
  Vec x0, x1, x2, x3;
};

HWY_INLINE void MakeRound(Blocks& blocks, Vec key0, Vec key1) {
  // Apply Random123's multipliers (Salmon et al. 2011).
  const Product of_x0 = Multiply(blocks.x0, 0xD2E7470EE14C6C93), of_x2 = Multiply(blocks.x2, 0xCA5A826395121157);
  blocks.x0 = hn::Xor(hn::Xor(of_x2.high, blocks.x1), key0);
  blocks.x1 = of_x2.low;
  blocks.x2 = hn::Xor(hn::Xor(of_x0.high, blocks.x3), key1);
  blocks.x3 = of_x0.low;
}

HWY_INLINE void Store(const Blocks& blocks, uint64_t* out) {
  hn::StoreInterleaved4(blocks.x0, blocks.x1, blocks.x2, blocks.x3, Word(), out);
}

size_t FillBlocks(uint64_t first, uint64_t key0, uint64_t key1, size_t count, uint64_t* out) {
  const Word word;
  const auto zero = hn::Zero(word);
  if (hn::Lanes(word) < kLanes) return 0;
  // Process two vectors at a time: each round of the cipher waits for the result of the previous round, so two
  // independent vectors hide the latency.
  size_t done = 0;
  for (; done + 2 * kLanes <= count; done += 2 * kLanes) {
    Blocks a{hn::Iota(word, first + done), zero, zero, zero};
    Blocks b{hn::Iota(word, first + done + kLanes), zero, zero, zero};
    uint64_t round_key0 = key0, round_key1 = key1;
    for (int round = 0; round < 10; ++round) {
      MakeRound(a, hn::Set(word, round_key0), hn::Set(word, round_key1));
      MakeRound(b, hn::Set(word, round_key0), hn::Set(word, round_key1));
      round_key0 += 0x9E3779B97F4A7C15;
      round_key1 += 0xBB67AE8584CAA73B;
    }
    Store(a, out + 4 * done);
    Store(b, out + 4 * (done + kLanes));
  }
  return done;
}

HalvesWithin FindWithin(const uint64_t* words, size_t count, uint32_t low, uint32_t last, uint32_t* within) {
  const hn::ScalableTag<uint64_t> word;
  const hn::Repartition<uint32_t, decltype(word)> half;
  const auto from = hn::Set(half, low), width = hn::Set(half, last - low);
  HalvesWithin found;
  size_t done = 0;  // count of random numbers that are already compared
  for (; done + hn::Lanes(half) <= count; done += hn::Lanes(half)) {
    const auto numbers = hn::BitCast(half, hn::LoadU(word, words + done / 2));
    const auto is_within = hn::Not(hn::Lt(width, hn::Sub(numbers, from)));  // numbers − from wraps around below `low`
    found.below += hn::CountTrue(half, hn::Lt(numbers, from));
    hn::StoreU(hn::Compress(numbers, is_within), half, within + found.within);
    found.within += hn::CountTrue(half, is_within);
  }
  for (; done < count; ++done) {
    const auto number = static_cast<uint32_t>(words[done / 2] >> (done % 2 == 0 ? 0 : 32));
    found.below += number < low;
    if (number - low <= last - low) within[found.within++] = number;
  }
  return found;
}

}  // namespace etude::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace etude {

HWY_EXPORT(FillBlocks);
HWY_EXPORT(FindWithin);

std::size_t FillPhiloxBlocks(std::uint64_t first, std::uint64_t key0, std::uint64_t key1, std::size_t count,
                             std::uint64_t* out) {
  return HWY_DYNAMIC_DISPATCH(FillBlocks)(first, key0, key1, count, out);
}

HalvesWithin FindHalvesWithin(const std::uint64_t* words, std::size_t count, std::uint32_t low, std::uint32_t last,
                              std::uint32_t* within) {
  return HWY_DYNAMIC_DISPATCH(FindWithin)(words, count, low, last, within);
}

}  // namespace etude
#endif
