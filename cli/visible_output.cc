#include "cli/visible_output.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string>
#include <string_view>
#include <utility>

#include "engine/base/utf8.h"

namespace etude {
namespace {

constexpr std::string_view kKeptControls = "\n\t";

/// Returns the first bytes of a character that was split between two writes.
std::string& BegunCharacter() {
  static std::string begun;
  return begun;
}

/// Returns the number of bytes at the end of `text` that begin a character without completing it.
std::size_t BegunAtEnd(std::string_view text) {
  for (std::size_t behind = 1; behind <= std::min<std::size_t>(3, text.size()); ++behind) {
    const auto byte = static_cast<unsigned char>(text[text.size() - behind]);
    if (byte >= 0xc0) return FirstCharacter(text.substr(text.size() - behind)).length == 0 ? behind : 0;
    if (byte < 0x80) return 0;
  }
  return 0;
}

int first_error = 0;

bool WriteAll(std::string_view text) {
  while (!text.empty()) {
    const ssize_t count = ::write(STDOUT_FILENO, text.data(), text.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      if (first_error == 0) first_error = errno;
      return false;
    }
    text.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

ssize_t WriteShown(void*, const char* bytes, std::size_t size) {
  const std::string text = std::exchange(BegunCharacter(), "") + std::string(bytes, size);
  const std::string_view whole = std::string_view(text).substr(0, text.size() - BegunAtEnd(text));
  BegunCharacter() = text.substr(whole.size());
  return WriteAll(Visible(whole, kKeptControls)) ? static_cast<ssize_t>(size) : 0;
}

int CloseShown(void*) { return WriteAll(Visible(BegunCharacter(), kKeptControls)) ? 0 : EOF; }

}  // namespace

int OutputError() { return first_error; }

void MakeOutputSafe() {
  std::FILE* const output =
      ::fopencookie(nullptr, "w", {.read = nullptr, .write = WriteShown, .seek = nullptr, .close = CloseShown});
  if (output == nullptr) return;
  if (::isatty(STDOUT_FILENO) == 1) std::setvbuf(output, nullptr, _IOLBF, BUFSIZ);
  stdout = output;  // glibc allows this assignment
}

}  // namespace etude
