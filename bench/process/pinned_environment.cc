#include "bench/process/pinned_environment.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace etude {
namespace {

/// Says in the environment of a process that is started anew which one it is; processes keep their number then.
constexpr std::string_view kRestarted = "ETUDE_RESTARTED";

std::string_view NameOf(std::string_view assignment) { return assignment.substr(0, assignment.find('=')); }

template <typename Texts>
bool Holds(const Texts& texts, std::string_view text) {
  return std::ranges::find(texts, text) != texts.end();
}

/// Whether the environment is what `ClosedEnvironment` would make of it.
bool IsClosed() {
  std::size_t pinned = 0;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (Holds(PinnedEnvironment(), *entry)) {
      ++pinned;
    } else if (!Holds(PassedVariables(), NameOf(*entry))) {
      return false;
    }
  }
  return pinned == PinnedEnvironment().size();
}

}  // namespace

const std::vector<std::string>& PinnedEnvironment() {
  static const std::vector<std::string> settings = {
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  // its sin, exp, … have FMA variants with other last bits
      "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",                  // llvmpipe compiles shaders for the CPU it meets
      "MESA_SHADER_CACHE_DISABLE=true",                    // the cache forgets for which CPU a shader was compiled
      "LP_NUM_THREADS=0",                                  // one process per core is faster than threads
      "LC_ALL=C.UTF-8",                                    // numbers and sorting of the libraries below us
  };
  return settings;
}

const std::vector<std::string>& PassedVariables() {
  static const std::vector<std::string> names = {"PATH",
                                                 "HOME",
                                                 "USER",
                                                 "LOGNAME",
                                                 "SHELL",
                                                 "PWD",
                                                 "TMPDIR",
                                                 "TERM",
                                                 "COLUMNS",
                                                 "LINES",
                                                 "NO_COLOR",
                                                 "ASAN_OPTIONS",
                                                 "LSAN_OPTIONS",
                                                 "UBSAN_OPTIONS",
                                                 "TSAN_OPTIONS",
                                                 "GCOV_PREFIX",
                                                 "GCOV_PREFIX_STRIP"};
  return names;
}

std::vector<std::string> ClosedEnvironment() {
  std::vector<std::string> closed = PinnedEnvironment();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (Holds(PassedVariables(), NameOf(*entry))) closed.emplace_back(*entry);
  }
  return closed;
}

Result<void> EnterPinnedEnvironment() {
  const std::string restarted = std::string(kRestarted) + "=" + std::to_string(::getpid());
  const char* mark = std::getenv(kRestarted.data());
  const bool is_restarted = mark != nullptr && restarted.substr(kRestarted.size() + 1) == mark;
  ::unsetenv(kRestarted.data());
  if (IsClosed()) return {};
  if (is_restarted) return Fail({}, "the pinned environment cannot be set for this process");
  std::vector<std::string> environment = ClosedEnvironment();
  environment.push_back(restarted);
  std::vector<char*> variables;
  for (std::string& assignment : environment) variables.push_back(assignment.data());
  variables.push_back(nullptr);
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line{std::istreambuf_iterator<char>(file), {}};
  std::vector<char*> arguments;
  for (std::size_t at = 0; at < line.size(); at += std::strlen(&line[at]) + 1) arguments.push_back(&line[at]);
  arguments.push_back(nullptr);
  ::execve("/proc/self/exe", arguments.data(), variables.data());
  return Fail({}, "this program cannot be started anew: {}", std::strerror(errno));
}

}  // namespace etude
