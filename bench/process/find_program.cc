#include "bench/process/find_program.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

namespace etude {
namespace {

bool IsProgram(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

}  // namespace

Result<std::string> FindProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (::access(name.c_str(), F_OK) != 0) return Fail({name, 0, 0}, "no such program: {}", std::strerror(errno));
    if (!IsProgram(name)) return Fail({name, 0, 0}, "is no program that may be executed");
    return name;
  }
  const char* variable = ::getenv("PATH");
  const std::string folders = variable != nullptr ? variable : "/usr/bin:/bin";
  for (std::size_t start = 0; start <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', start), folders.size());
    const std::string folder = end == start ? "." : folders.substr(start, end - start);
    if (std::string path = folder + "/" + name; !name.empty() && IsProgram(path)) return path;
    start = end + 1;
  }
  return Fail({}, "no program '{}' in PATH ({})", name, folders);
}

}  // namespace etude
