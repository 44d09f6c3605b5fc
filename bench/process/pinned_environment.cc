#include "bench/process/pinned_environment.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

namespace etude {
namespace {

bool IsSet(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  const char* value = std::getenv(assignment.substr(0, equals).c_str());
  return value != nullptr && assignment.substr(equals + 1) == value;
}

}  // namespace

const std::vector<std::string>& PinnedEnvironment() {
  static const std::vector<std::string> settings = {
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  // its sin, exp, … have FMA variants with other last bits
      "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",                  // llvmpipe compiles shaders for the CPU it meets
      "MESA_SHADER_CACHE_DISABLE=true",                    // the cache forgets for which CPU a shader was compiled
      "LP_NUM_THREADS=0",                                  // one process per core is faster than threads
  };
  return settings;
}

Result<void> EnterPinnedEnvironment() {
  const std::vector<std::string>& pinned = PinnedEnvironment();
  if (std::all_of(pinned.begin(), pinned.end(), IsSet)) return {};
  constexpr const char* kTried = "ETUDE_RESTARTED";
  if (std::getenv(kTried) != nullptr) return Fail({}, "the pinned environment cannot be set for this process");
  ::setenv(kTried, "1", 1);
  for (const std::string& assignment : pinned) {
    const std::size_t equals = assignment.find('=');
    ::setenv(assignment.substr(0, equals).c_str(), assignment.substr(equals + 1).c_str(), 1);
  }
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line{std::istreambuf_iterator<char>(file), {}};
  std::vector<char*> arguments;
  for (std::size_t at = 0; at < line.size(); at += std::strlen(&line[at]) + 1) arguments.push_back(&line[at]);
  arguments.push_back(nullptr);
  ::execv("/proc/self/exe", arguments.data());
  return Fail({}, "this program cannot be started anew: {}", std::strerror(errno));
}

}  // namespace etude
