#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace etude {

/// A 64-bit fingerprint (XXH3) of a sequence of values, equal on every machine. Fingerprints of pipeline stages show
/// the first stage at which two runs differ.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  Digest& Add(std::string_view bytes);
  Digest& Add(std::span<const std::uint8_t> bytes);
  Digest& Add(double value);
  Digest& Add(std::int64_t value);
  Digest& Add(std::span<const double> values);

  std::uint64_t Value() const;
  /// Returns the value as sixteen lower-case hexadecimal digits.
  std::string Hex() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Returns the fingerprint of one string; a stable replacement for std::hash.
std::uint64_t Fingerprint(std::string_view text);

}  // namespace etude
