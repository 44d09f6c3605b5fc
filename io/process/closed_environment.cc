#include "io/process/closed_environment.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>

namespace etude {
namespace {

constexpr const char *kShaderTarget = "GALLIUM_OVERRIDE_CPU_CAPS", *kShaderCache = "MESA_SHADER_CACHE_DISABLE";

constexpr std::string_view kPassed[] = {
    "PATH",          "HOME",         "USER",        "LOGNAME",           "SHELL",    "PWD",          "TMPDIR",
    "TERM",          "COLUMNS",      "LINES",       "NO_COLOR",          "ETUDE_GL", "ASAN_OPTIONS", "LSAN_OPTIONS",
    "UBSAN_OPTIONS", "TSAN_OPTIONS", "GCOV_PREFIX", "GCOV_PREFIX_STRIP", "LD_DEBUG"};

std::string_view NameOf(std::string_view assignment) { return assignment.substr(0, assignment.find('=')); }

template <typename Texts>
bool Holds(const Texts& texts, std::string_view text) {
  return std::ranges::find(texts, text) != std::ranges::end(texts);
}

}  // namespace

const std::vector<std::string>& PinnedEnvironment() {
  static const std::vector<std::string> settings = {
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  // FMA variants of sin, exp, … differ in the last bits
      std::string(kShaderTarget) + "=sse4.1",              // else llvmpipe compiles shaders for the machine's CPU
      std::string(kShaderCache) + "=true",                 // cached shaders may be from another CPU
      "LP_NUM_THREADS=0",                                  // one process per core is faster than threads
      "LC_ALL=C.UTF-8",                                    // fixes number formats and sort orders in libraries
  };
  return settings;
}

std::vector<std::string> ClosedEnvironment() {
  std::vector<std::string> closed = PinnedEnvironment();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (Holds(kPassed, NameOf(*entry))) closed.emplace_back(*entry);
  }
  return closed;
}

std::string FirstDifferenceFromClosed() {
  std::vector<std::string> missing = PinnedEnvironment();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (std::erase(missing, *entry) == 0 && !Holds(kPassed, NameOf(*entry)) && NameOf(*entry) != kKeyVariable) {
      return std::string(NameOf(*entry));
    }
  }
  return missing.empty() ? "" : missing.front();
}

void DrawAsFastAsPossible() {
  ::unsetenv(kShaderTarget);
  ::unsetenv(kShaderCache);
}

}  // namespace etude
