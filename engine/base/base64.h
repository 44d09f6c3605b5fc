#pragma once

#include <span>
#include <string>
#include <string_view>

namespace etude {

/// Encodes bytes as Base64 (RFC 4648), with padding.
std::string Base64(std::span<const unsigned char> bytes);
std::string Base64(std::string_view bytes);

}  // namespace etude
