#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <string>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// 256 bits: a secret key, what a block cipher makes of a block, a digest.
using Words256 = std::array<std::uint64_t, 4>;

/// Threefish-256 (Random123's Threefry 4×64 of 72 rounds): without the key, nothing tells its output from noise.
Words256 Encrypt(const Words256& key, const Words256& block);

/// The key of a run's dice: a number that anybody may know and try, or a secret of 256 bits that is known by its
/// digest.
class Seed {
 public:
  /// A plain seed, wherever a number is given for one.
  constexpr Seed(std::uint64_t number = 1) : words_{number} {}  // NOLINT(google-explicit-constructor)
  static constexpr Seed Secret(const Words256& key) { return {Kind::kSecret, key}; }

  bool IsPlain() const { return kind_ == Kind::kPlain; }
  /// True if the dice can be thrown: of a secret seed that was read from a manifest only the digest is known.
  bool IsOpen() const { return kind_ != Kind::kDigest; }
  /// The number of a plain seed.
  std::uint64_t number() const { return words_[0]; }
  /// The key of a secret seed that is open.
  const Words256& key() const { return words_; }
  /// Tells a secret key without telling it: the key's cipher of a fixed block, 64 hexadecimal digits (Davies and
  /// Meyer).
  std::string Digest() const;
  /// Keys what is no part of a world (samples of statistics): the plain number, or one that the digest makes.
  std::uint64_t Public() const;
  /// The same, of a secret seed by its digest alone.
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

/// Writes the seed for people and manifests: "7"; "secret" and the digest.
std::string ToString(const Seed& seed);
/// Reads that; a secret one is not open.
Result<Seed> ParseSeed(std::string_view text);
/// Reads 64 hexadecimal digits.
Result<Words256> ParseWords256(std::string_view digits);
/// Writes them.
std::string Hex(const Words256& words);

}  // namespace etude
