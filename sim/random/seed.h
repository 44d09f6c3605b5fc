#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// 256 bits: a secret key, a block of a block cipher, or a digest.
using Words256 = std::array<std::uint64_t, 4>;

/// Encrypts a block with Threefish-256 (Random123's Threefry 4×64 with 72 rounds). Without the key, nobody can
/// distinguish the output from noise.
Words256 Encrypt(const Words256& key, const Words256& block);

/// The seed of a run: either a plain number that anybody may know, or a secret key of 256 bits that a digest
/// identifies.
class Seed {
 public:
  /// Makes a plain seed. The conversion is implicit, so a number can be passed as a seed.
  constexpr Seed(std::uint64_t number = 1) : words_{number} {}  // NOLINT(google-explicit-constructor)
  static constexpr Seed Secret(const Words256& key) { return {Kind::kSecret, key}; }

  bool IsPlain() const { return kind_ == Kind::kPlain; }
  /// Returns true if random numbers can be drawn. They cannot if the seed is secret and was read from a manifest,
  /// because a manifest contains only the seed's digest.
  bool IsOpen() const { return kind_ != Kind::kDigest; }
  /// Returns the number of a plain seed.
  std::uint64_t number() const { return words_[0]; }
  /// Returns the key of an open secret seed.
  const Words256& key() const { return words_; }
  /// Returns 64 hexadecimal digits that identify a secret key without revealing it: the encryption of a fixed block
  /// with the key, combined with the block (Davies–Meyer). Returns an empty text for a plain seed.
  std::string Digest() const;
  /// Returns a seed for random numbers outside of worlds (such as samples of statistics): the plain number, or a number
  /// derived from the digest.
  std::uint64_t Public() const;
  /// Returns the seed without its key: a plain seed is unchanged, and a secret seed keeps only its digest.
  Seed WithoutKey() const;

  friend auto operator<=>(const Seed&, const Seed&) = default;

 private:
  enum class Kind : std::uint8_t { kPlain, kSecret, kDigest };
  constexpr Seed(Kind kind, const Words256& words) : kind_(kind), words_(words) {}
  friend Result<Seed> ParseSeed(std::string_view text);
  Words256 DigestWords() const;

  Kind kind_ = Kind::kPlain;
  Words256 words_{};
};

/// Writes the seed for people and manifests: "7", or "secret" and the digest.
std::string ToString(const Seed& seed);
/// Reads the output of ToString. If the text states a secret seed, the result has only the digest and is not open
/// (IsOpen). Fails for any other text.
Result<Seed> ParseSeed(std::string_view text);
/// Reads 64 hexadecimal digits. Fails for any other text.
Result<Words256> ParseWords256(std::string_view digits);
/// Writes 64 hexadecimal digits.
std::string Hex(const Words256& words);

}  // namespace etude
