#include "sim/random/stream.h"

#include <Random123/philox.h>
#include <fmt/core.h>

#include <algorithm>
#include <cassert>
#include <cmath>

#include "engine/base/angles.h"
#include "engine/base/digest.h"
#include "sim/random/philox_lanes.h"

namespace etude {

namespace {

/// Derives a key from a text by CBC-MAC. The first block is the text's length, so no input is a prefix of another.
Words256 DeriveKey(const Words256& key, std::string_view text) {
  Words256 chained = Encrypt(key, {text.size()});
  while (!text.empty()) {
    std::array<unsigned char, sizeof(Words256)> bytes{};
    const std::size_t count = std::min(text.size(), bytes.size());
    std::copy_n(text.begin(), count, bytes.begin());
    for (std::size_t i = 0; i < bytes.size(); ++i) chained[i / 8] ^= std::uint64_t{bytes[i]} << (8 * (i % 8));
    chained = Encrypt(key, chained);
    text.remove_prefix(count);
  }
  return chained;
}

}  // namespace

RandomStream::RandomStream(const WorldKey& world, std::string_view purpose) : is_secret_(!world.suite_seed.IsPlain()) {
  assert(world.suite_seed.IsOpen());
  if (is_secret_) {
    key_ = DeriveKey(world.suite_seed.key(), fmt::format("{}/{}/{}/{}/{}", world.scenario.size(), world.scenario,
                                                         world.trial, purpose.size(), purpose));
  } else {
    key_ = {Fingerprint(fmt::format("{}/{}/{}", world.suite_seed.number(), world.scenario, world.trial)),
            Fingerprint(purpose)};
  }
}

Words256 RandomStream::Block(std::uint64_t counter) const {
  if (is_secret_) return Encrypt(key_, {counter});
  const auto block = r123::Philox4x64()({{counter, 0, 0, 0}}, {{key_[0], key_[1]}});
  return {block[0], block[1], block[2], block[3]};
}

std::uint64_t RandomStream::Bits() {
  if (used_ == 4) {
    block_ = Block(counter_++);
    used_ = 0;
  }
  return block_[used_++];
}

void RandomStream::FillBits(std::span<std::uint64_t> out) {
  std::size_t i = 0;
  while (i < out.size() && used_ != 4) out[i++] = Bits();
  if (!is_secret_) {
    const std::size_t blocks = FillPhiloxBlocks(counter_, key_[0], key_[1], (out.size() - i) / 4, out.data() + i);
    counter_ += blocks;
    i += 4 * blocks;
  }
  for (; i + 4 <= out.size(); i += 4) std::ranges::copy(Block(counter_++), out.begin() + i);
  while (i < out.size()) out[i++] = Bits();
}

double RandomStream::Uniform() { return static_cast<double>(Bits() >> 11) * 0x1.0p-53; }

double RandomStream::Normal() {
  if (has_spare_normal_) {
    has_spare_normal_ = false;
    return spare_normal_;
  }
  const double radius = std::sqrt(-2.0 * std::log(1.0 - Uniform()));  // 1 − u is in (0, 1]
  const double angle = 2.0 * kPi * Uniform();
  spare_normal_ = radius * std::sin(angle);
  has_spare_normal_ = true;
  return radius * std::cos(angle);
}

glm::dvec3 RandomStream::Normal3() {
  const double x = Normal(), y = Normal(), z = Normal();
  return {x, y, z};
}

std::uint64_t RandomStream::IndexBelow(std::uint64_t count) {
  // Rejection sampling: reject values beyond the last whole multiple of `count`, so that all results are equally
  // likely.
  const std::uint64_t limit = ~std::uint64_t{0} - (~std::uint64_t{0} % count);
  std::uint64_t bits = Bits();
  while (bits >= limit) bits = Bits();
  return bits % count;
}

}  // namespace etude
