#include "bench/clips/fbx.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <utility>

#include "bench/process/pinned_environment.h"

namespace etude {
namespace {

constexpr const char* kModule = "etude_clips_assimp.so";  // found beside the program, by its run path
constexpr rlim_t kMemoryBytes = rlim_t{4} << 30, kProcessorSeconds = 60;
constexpr std::size_t kLargestGlb = std::size_t{1} << 30;
constexpr unsigned kOldestVersion = 7;
constexpr int kSaidGlb = 0, kSaidComplaint = 1;

constexpr std::string_view kBinaryStart = "Kaydara FBX Binary", kTextStart = "; FBX";

/// The first digit of a file's version, 0 when it tells none.
unsigned MajorVersion(std::string_view bytes) {
  if (bytes.starts_with(kTextStart)) {
    const std::size_t digit = bytes.find_first_not_of(' ', kTextStart.size());
    return digit < bytes.size() && bytes[digit] >= '0' && bytes[digit] <= '9'
               ? static_cast<unsigned>(bytes[digit] - '0')
               : 0;
  }
  constexpr std::size_t kVersionAt = 23;
  std::uint32_t version = 0;
  if (bytes.size() >= kVersionAt + sizeof version) std::memcpy(&version, bytes.data() + kVersionAt, sizeof version);
  return version / 1000;
}

/// The build of assimp that is loaded, as the manifest tells those of other libraries.
std::string NameOfReader() {
  constexpr std::size_t kToldDigits = 20;
  for (const auto& [name, build] : LoadedLibraries()) {
    if (name.starts_with("libassimp.")) return name + " (" + build.substr(0, kToldDigits) + ")";
  }
  return "an assimp within the program";
}

/// The address space that this process takes already: a limit counts it, too.
rlim_t MappedBytes() {
  rlim_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE));
}

[[noreturn]] void BeReader(std::string_view bytes, int output, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(kSaidComplaint);  // it died before the line above
  for (const auto& [resource, most] :
       {std::pair{RLIMIT_AS, MappedBytes() + kMemoryBytes}, {RLIMIT_CPU, kProcessorSeconds}, {RLIMIT_CORE, 0}}) {
    const rlimit limit{most, most};
    ::setrlimit(resource, &limit);
  }
  // What it falls on ends it, whatever the parent does on such signals.
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(fatal, SIG_DFL);
  std::string said;
  bool went_well = false;
  if (void* module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL); module == nullptr) {
    said = std::string("an FBX file, for which assimp is not there (") + ::dlerror() +
           "); install Debian's libassimp-dev, and build again";
  } else if (const void* symbol = ::dlsym(module, "etude_clips_assimp"); symbol == nullptr) {
    said = std::string(kModule) + " is no module of this program";
  } else {
    went_well = (*static_cast<GlbOfFbxBytes* const*>(symbol))(bytes, said);
    if (went_well) said.insert(0, NameOfReader() + "\n");
  }
  std::FILE* file = ::fdopen(output, "wb");
  std::fwrite(said.data(), 1, said.size(), file);
  std::fflush(file);
  ::_exit(went_well ? kSaidGlb : kSaidComplaint);
}

}  // namespace

bool IsFbx(std::string_view bytes) { return bytes.starts_with(kBinaryStart) || bytes.starts_with(kTextStart); }

Result<FbxMotion> ReadFbx(std::string_view bytes, const std::string& path) {
  if (const unsigned version = MajorVersion(bytes); version > 0 && version < kOldestVersion) {
    return Fail({path}, "an FBX file of version {}; allowed: {} (of 2011 or later): export it anew, or convert it",
                version, kOldestVersion);
  }
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return Fail({}, "no pipe can be made: {}", std::strerror(errno));
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) BeReader(bytes, ends[1], parent);
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return Fail({}, "no process can be started: {}", std::strerror(errno));
  }
  std::string said;
  std::array<char, 1 << 16> chunk;
  for (;;) {
    const ssize_t count = ::read(ends[0], chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    said.append(chunk.data(), static_cast<std::size_t>(count));
    if (said.size() > kLargestGlb) ::kill(child, SIGKILL);
  }
  ::close(ends[0]);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == kSaidGlb) {
    const std::size_t line = said.find('\n');
    return FbxMotion{.glb = said.substr(line + 1), .reader = said.substr(0, line)};
  }
  if (WIFEXITED(status)) return Fail({path}, "{}", said.empty() ? "a damaged FBX file: its reader gave up" : said);
  const int signal = WTERMSIG(status);
  if (signal == SIGXCPU || signal == SIGKILL) {
    return Fail({path},
                "an FBX file too large to read: at most {} s of processor time, {} GB of memory and {} GB of result",
                kProcessorSeconds, kMemoryBytes >> 30, kLargestGlb >> 30);
  }
  return Fail({path}, "a damaged FBX file: its reader ended with signal {} ({})", signal, ::strsignal(signal));
}

}  // namespace etude
