#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Describes a file that holds no motion known here, and what to do with it, for a complaint: by its first bytes, or by
/// its first word.
std::string DescribeOtherFile(std::string_view bytes, std::string_view first_word);

}  // namespace etude
