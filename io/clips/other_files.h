#pragma once

#include <string>
#include <string_view>

namespace etude {

/// Describes, for an error message, a file that holds no motion of a known format, and suggests what to do with the
/// file. The kind of file is recognised by its first bytes or its first word.
std::string DescribeOtherFile(std::string_view bytes, std::string_view first_word);

}  // namespace etude
