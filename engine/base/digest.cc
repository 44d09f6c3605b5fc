#include "engine/base/digest.h"

#include <fmt/core.h>
#include <xxhash.h>

namespace etude {

struct Digest::State {
  XXH3_state_t* xxh = XXH3_createState();
  State() { XXH3_64bits_reset(xxh); }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Digest::Digest() : state_(std::make_unique<State>()) {}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

Digest& Digest::Add(std::span<const std::uint8_t> bytes) {
  XXH3_64bits_update(state_->xxh, bytes.data(), bytes.size());
  return *this;
}

Digest& Digest::Add(std::string_view bytes) {
  XXH3_64bits_update(state_->xxh, bytes.data(), bytes.size());
  return *this;
}

Digest& Digest::Add(double value) {
  XXH3_64bits_update(state_->xxh, &value, sizeof value);
  return *this;
}

Digest& Digest::Add(std::int64_t value) {
  XXH3_64bits_update(state_->xxh, &value, sizeof value);
  return *this;
}

Digest& Digest::Add(std::span<const double> values) {
  XXH3_64bits_update(state_->xxh, values.data(), values.size_bytes());
  return *this;
}

std::uint64_t Digest::Value() const { return XXH3_64bits_digest(state_->xxh); }

std::string Digest::Hex() const { return fmt::format("{:016x}", Value()); }

std::uint64_t Fingerprint(std::string_view text) { return XXH3_64bits(text.data(), text.size()); }

}  // namespace etude
