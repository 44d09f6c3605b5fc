#include "engine/base/base64.h"

namespace etude {

std::string Base64(std::span<const unsigned char> bytes) {
  constexpr std::string_view kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t have = bytes.size() - i;
    const unsigned b1 = have > 1 ? bytes[i + 1] : 0u;
    const unsigned b2 = have > 2 ? bytes[i + 2] : 0u;
    const unsigned triple = static_cast<unsigned>(bytes[i]) << 16 | b1 << 8 | b2;
    out += kDigits[triple >> 18];
    out += kDigits[triple >> 12 & 63];
    out += have > 1 ? kDigits[triple >> 6 & 63] : '=';
    out += have > 2 ? kDigits[triple & 63] : '=';
  }
  return out;
}

std::string Base64(std::string_view bytes) {
  return Base64(std::span(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()));
}

}  // namespace etude
