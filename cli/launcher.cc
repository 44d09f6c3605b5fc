#include <unistd.h>

#include <cerrno>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "io/process/closed_environment.h"

// The program `etude`. It sets the closed environment and becomes etude_program, which does the work. This program
// links only the C library, so that the many libraries of etude_program are loaded once, in their final environment.
int main(int, char** argv) {
  std::vector<std::string> environment = etude::ClosedEnvironment();
  if (const char* key = std::getenv(etude::kKeyVariable)) {
    environment.push_back(std::string(etude::kKeyVariable) + "=" + key);
  }
  std::vector<char*> variables;
  for (std::string& assignment : environment) variables.push_back(assignment.data());
  variables.push_back(nullptr);

  // In the build folder, etude_program is beside this program; after installation, it is in the folder of the modules.
  char self[PATH_MAX];
  const ssize_t size = ::readlink("/proc/self/exe", self, sizeof self);
  if (size <= 0 || size == sizeof self) {
    std::fprintf(stderr, "etude: this machine does not tell where this program is (/proc/self/exe)\n");
    return 3;
  }
  const std::string path(self, static_cast<std::size_t>(size));
  const std::string folder = path.substr(0, path.rfind('/') + 1);
  const std::string beside = folder + "etude_program", installed = folder + ETUDE_MODULES_FROM_PROGRAM "/etude_program";
  for (const std::string& program : {beside, installed}) {
    ::execve(program.c_str(), argv, variables.data());
    if (errno == ENOENT) continue;
    std::fprintf(stderr, "etude: cannot start '%s': %s\n", program.c_str(), std::strerror(errno));
    return 3;
  }
  std::fprintf(stderr, "etude: cannot find etude_program; it must be '%s' or '%s'\n", beside.c_str(),
               installed.c_str());
  return 3;
}
