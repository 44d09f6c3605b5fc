#include "sim/random/seed.h"

#include <Random123/threefry.h>

#include <charconv>

#include "engine/base/text.h"

namespace etude {
namespace {

constexpr std::string_view kSecret = "secret ";
constexpr std::size_t kDigitsPerWord = 16;
/// The text "etude: digest of a secret seed" as a block of the cipher.
constexpr Words256 kDigestBlock = {0x6574'7564'653a'2064, 0x6967'6573'7420'6f66, 0x2061'2073'6563'7265,
                                   0x7420'7365'6564'0000};
constexpr std::uint64_t kExactInJson = (std::uint64_t{1} << 53) - 1;

}  // namespace

Words256 Encrypt(const Words256& key, const Words256& block) {
  r123::Threefry4x64::ctr_type plain;
  r123::Threefry4x64::key_type under;
  for (std::size_t i = 0; i < 4; ++i) {
    plain[i] = block[i];
    under[i] = key[i];
  }
  const auto cipher = r123::Threefry4x64_R<72>()(plain, under);
  return {cipher[0], cipher[1], cipher[2], cipher[3]};
}

Words256 Seed::DigestWords() const {
  if (kind_ == Kind::kDigest) return words_;
  Words256 digest = Encrypt(words_, kDigestBlock);
  for (std::size_t i = 0; i < 4; ++i) digest[i] ^= kDigestBlock[i];
  return digest;
}

std::string Seed::Digest() const { return IsPlain() ? "" : Hex(DigestWords()); }

std::uint64_t Seed::Public() const { return IsPlain() ? number() : DigestWords()[0] & kExactInJson; }

Seed Seed::WithoutKey() const { return IsPlain() ? *this : Seed(Kind::kDigest, DigestWords()); }

std::string ToString(const Seed& seed) {
  return seed.IsPlain() ? std::to_string(seed.number()) : std::string(kSecret) + seed.Digest();
}

Result<Seed> ParseSeed(std::string_view text) {
  if (text.starts_with(kSecret)) {
    ASSIGN_OR_RETURN(const Words256 digest, ParseWords256(text.substr(kSecret.size())));
    return Seed(Seed::Kind::kDigest, digest);
  }
  if (const auto number = ParseNumber<std::uint64_t>(text)) return Seed(*number);
  return Fail({}, "'{}' is not a seed; allowed: a whole number, or 'secret' and a digest", text);
}

Result<Words256> ParseWords256(std::string_view digits) {
  Words256 words{};
  bool is_whole = digits.size() == words.size() * kDigitsPerWord;
  for (std::size_t i = 0; i < words.size() && is_whole; ++i) {
    const std::string_view part = digits.substr(i * kDigitsPerWord, kDigitsPerWord);
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), words[i], 16);
    is_whole = error == std::errc() && end == part.data() + part.size();
  }
  if (is_whole) return words;
  return Fail({}, "not 64 hexadecimal digits");
}

std::string Hex(const Words256& words) {
  return fmt::format("{:016x}{:016x}{:016x}{:016x}", words[0], words[1], words[2], words[3]);
}

}  // namespace etude
