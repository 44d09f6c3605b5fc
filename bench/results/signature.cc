#include "bench/results/signature.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "bench/results/seal.h"
#include "io/files/files.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

using Bytes = std::vector<unsigned char>;

// These are sizes in minisign's files, in bytes (https://jedisct1.github.io/minisign/#signature-format). A public key
// consists of the algorithm (2), the key ID (kNumber) and the key. A secret key consists of the algorithms of
// signature, password and checksum (2, 2, 2), salt and costs (32, 8, 8; zero without a password), the key ID, the key
// and a checksum (kSum).
constexpr std::size_t kNumber = 8, kBeforeSecret = 54, kSum = 32;
constexpr std::size_t kSecretSize = kBeforeSecret + kNumber + crypto_sign_SECRETKEYBYTES + kSum;
constexpr std::size_t kPublicSize = 2 + kNumber + crypto_sign_PUBLICKEYBYTES;
constexpr std::size_t kSignatureSize = 2 + kNumber + crypto_sign_BYTES;
constexpr std::string_view kComment = "untrusted comment: ", kTrusted = "trusted comment: ";
constexpr std::string_view kHashed = "ED";  // the algorithm that signs the file's digest

std::string Encode(std::span<const unsigned char> bytes) {
  std::string text(sodium_base64_ENCODED_LEN(bytes.size(), sodium_base64_VARIANT_ORIGINAL), '\0');
  sodium_bin2base64(text.data(), text.size(), bytes.data(), bytes.size(), sodium_base64_VARIANT_ORIGINAL);
  text.pop_back();  // removes the terminating zero
  return text;
}

/// Decodes base64. Returns no bytes if the text does not encode exactly `size` bytes.
Bytes Decode(std::string_view text, std::size_t size) {
  Bytes bytes(size + 3);
  std::size_t length = 0;
  if (sodium_base642bin(bytes.data(), bytes.size(), text.data(), text.size(), nullptr, &length, nullptr,
                        sodium_base64_VARIANT_ORIGINAL) != 0 ||
      length != size) {
    return {};
  }
  bytes.resize(size);
  return bytes;
}

std::vector<std::string> LinesOf(std::string_view text) {
  std::vector<std::string> lines(1);
  for (const char c : text) {
    if (c == '\n') {
      lines.emplace_back();
    } else if (c != '\r') {
      lines.back() += c;
    }
  }
  return lines;
}

Bytes Concat(std::span<const unsigned char> first, std::string_view second) {
  Bytes joined(first.begin(), first.end());
  joined.insert(joined.end(), second.begin(), second.end());
  return joined;
}

using Blake = std::array<unsigned char, crypto_generichash_BYTES_MAX>;

Blake DigestOf(std::string_view text) {
  Blake digest;
  crypto_generichash(digest.data(), digest.size(), reinterpret_cast<const unsigned char*>(text.data()), text.size(),
                     nullptr, 0);
  return digest;
}

Result<std::string> DigestOfFile(const FilePath& path) {
  crypto_generichash_state state;
  crypto_generichash_init(&state, nullptr, 0, crypto_generichash_BYTES_MAX);
  RETURN_IF_ERROR(ReadInChunks(path, [&](std::string_view bytes) {
    crypto_generichash_update(&state, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  }));
  Blake digest;
  crypto_generichash_final(&state, digest.data(), digest.size());
  std::string hex;
  for (const unsigned char byte : digest) hex += fmt::format("{:02x}", byte);
  return hex;
}

Result<std::string> ListDigests(const fs::path& folder) {
  if (sodium_init() < 0) return Fail({}, "the library libsodium does not work on this machine");
  ASSIGN_OR_RETURN(auto names, SealedNames(folder));
  names.insert(names.begin(), kSealFile);
  std::string text;
  for (const std::string& name : names) {
    ASSIGN_OR_RETURN(const auto digest, DigestOfFile(Inside(folder) / name));
    text += digest + "  " + name + "\n";
  }
  return text;
}

/// Returns a key ID as minisign shows it: in hexadecimal digits, the last byte first.
std::string NumberOf(std::span<const unsigned char> bytes) {
  std::string text;
  for (std::size_t i = kNumber; i-- > 0;) text += fmt::format("{:02X}", bytes[i]);
  return text;
}

}  // namespace

Result<void> SignRun(const fs::path& folder, const std::string& secret_key) {
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(secret_key));
  const std::vector<std::string> lines = LinesOf(text);
  // Read the secret key.
  Bytes key = Decode(lines.size() < 2 ? "" : lines[1], kSecretSize);
  if (key.empty() || key[0] != 'E' || key[1] != 'd') {
    return Fail({secret_key}, "is not a secret key of minisign; 'minisign -G -W' makes a secret key");
  }
  if (key[2] != 0 || key[3] != 0) {
    return Fail({secret_key},
                "is a secret key with a password, but this program cannot ask for a password; 'minisign -G -W' makes a "
                "key without a password");
  }
  // Sign the digest of signed.b2, and then that signature together with the trusted comment.
  ASSIGN_OR_RETURN(const auto digests, ListDigests(folder));
  const unsigned char* const number = key.data() + kBeforeSecret;
  const unsigned char* const secret = number + kNumber;
  const Blake digest = DigestOf(digests);
  Bytes signature(kSignatureSize);
  std::copy(kHashed.begin(), kHashed.end(), signature.begin());
  std::copy_n(number, kNumber, signature.begin() + 2);
  crypto_sign_detached(signature.data() + 2 + kNumber, nullptr, digest.data(), digest.size(), secret);
  const std::string trusted =
      std::string("file:") + kSignedFile + "\thashed";  // without a time, so that equal runs give equal bytes
  const Bytes all = Concat(std::span(signature).subspan(2 + kNumber), trusted);
  std::array<unsigned char, crypto_sign_BYTES> over_all;
  crypto_sign_detached(over_all.data(), nullptr, all.data(), all.size(), secret);
  sodium_memzero(key.data(), key.size());
  RETURN_IF_ERROR(WriteFileAtomically(Inside(folder) / kSignedFile, digests));
  return WriteFileAtomically(Inside(folder) / kSignatureFile,
                             fmt::format("{}signature of a run of Etude\n{}\n{}{}\n{}\n", kComment, Encode(signature),
                                         kTrusted, trusted, Encode(over_all)));
}

Result<std::string> CheckSignature(const fs::path& folder, const std::string& public_key) {
  // Read the public key, from a file or as text.
  std::string key_text = public_key;
  if (std::error_code none; fs::exists(public_key, none)) {
    ASSIGN_OR_RETURN(const auto text, ReadWholeFile(public_key));
    const std::vector<std::string> lines = LinesOf(text);
    key_text = lines.size() < 2 ? "" : lines[1];
  }
  const Bytes key = Decode(key_text, kPublicSize);
  if (key.empty() || key[0] != 'E' || key[1] != 'd') {
    return Fail({public_key}, "is neither a public key of minisign nor a file with a public key");
  }
  // Read the signature. It must be a signature of this key.
  const FilePath path = Inside(folder) / kSignatureFile;
  ASSIGN_OR_RETURN(const auto text, ReadWholeFile(path));
  const std::vector<std::string> lines = LinesOf(text);
  const Bytes signature = Decode(lines.size() < 4 ? "" : lines[1], kSignatureSize);
  const Bytes over_all = Decode(lines.size() < 4 ? "" : lines[3], crypto_sign_BYTES);
  if (signature.empty() || over_all.empty() || !lines[2].starts_with(kTrusted) ||
      !std::ranges::equal(kHashed, std::span(signature).first(2))) {
    return Fail({path.string()}, "is not a signature in the format that minisign 0.10 and later versions write");
  }
  const std::span<const unsigned char> number = std::span(key).subspan(2, kNumber);
  if (!std::ranges::equal(number, std::span(signature).subspan(2, kNumber))) {
    return Fail({path.string()}, "was made with key {}, but the given key is {}",
                NumberOf(std::span(signature).subspan(2, kNumber)), NumberOf(number));
  }
  // The signatures of signed.b2 and of the trusted comment must be valid.
  ASSIGN_OR_RETURN(const auto signed_text, ReadWholeFile(Inside(folder) / kSignedFile));
  const Blake digest = DigestOf(signed_text);
  const Bytes all = Concat(std::span(signature).subspan(2 + kNumber), lines[2].substr(kTrusted.size()));
  const unsigned char* const holder = key.data() + 2 + kNumber;
  if (crypto_sign_verify_detached(signature.data() + 2 + kNumber, digest.data(), digest.size(), holder) != 0 ||
      crypto_sign_verify_detached(over_all.data(), all.data(), all.size(), holder) != 0) {
    return Fail({path.string()}, "is not a valid signature of {}: one of the two files was changed", kSignedFile);
  }
  // The files must equal the signed ones; otherwise name the first file that differs.
  ASSIGN_OR_RETURN(const auto found, ListDigests(folder));
  if (found == signed_text) return NumberOf(number);
  const std::vector<std::string> then = LinesOf(signed_text), now = LinesOf(found);
  const auto differs = std::ranges::mismatch(then, now);
  const std::string& line = differs.in1 != then.end() && !differs.in1->empty() ? *differs.in1 : *differs.in2;
  return Fail({(folder / line.substr(std::min(line.size(), 2 * sizeof(Blake) + 2))).string()},
              "was changed after it was signed");
}

}  // namespace etude
