#include "bench/clips/fbx.h"

#include <dlfcn.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fstream>
#include <optional>
#include <utility>

#include "bench/process/pinned_environment.h"
#include "engine/base/machine.h"

namespace etude {
namespace {

constexpr const char* kModule = "etude_clips_assimp.so";  // found beside the program, by its run path
constexpr rlim_t kMemoryBytes = rlim_t{4} << 30, kProcessorSeconds = 60;
constexpr std::size_t kLargestGlb = std::size_t{1} << 30;
constexpr unsigned kOldestVersion = 7;
constexpr const char* kGaveUp = "a damaged FBX file: its reader gave up";
constexpr char kSaidGlb = 'G', kSaidComplaint = 'C';

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

void Limit(int resource, rlim_t most) {
  const rlimit limit{most, most};
  ::setrlimit(resource, &limit);
}

/// Allows so much processor time from now on.
void AllowProcessorTime(rlim_t seconds) {
  rlimit limit{};
  ::getrlimit(RLIMIT_CPU, &limit);
  const rlim_t spent = static_cast<rlim_t>(std::clock() / CLOCKS_PER_SEC) + 1;
  limit.rlim_cur = std::min(limit.rlim_max, spent + seconds);
  ::setrlimit(RLIMIT_CPU, &limit);
}

/// Sends a length and so many bytes; false when nobody is at the other end.
bool SendBlock(int socket, std::string_view bytes) {
  const std::uint64_t size = bytes.size();
  for (std::string_view part : {std::string_view(reinterpret_cast<const char*>(&size), sizeof size), bytes}) {
    while (!part.empty()) {
      const ssize_t count = ::send(socket, part.data(), part.size(), MSG_NOSIGNAL);
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      part.remove_prefix(static_cast<std::size_t>(count));
    }
  }
  return true;
}

bool Receive(int socket, char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::recv(socket, bytes, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

/// Receives what SendBlock sent; nothing when nobody is at the other end, or it is longer than `most`.
std::optional<std::string> ReceiveBlock(int socket, std::size_t most, bool& is_too_long) {
  std::uint64_t size = 0;
  if (!Receive(socket, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
  is_too_long = size > most;
  std::string bytes;
  if (is_too_long) return std::nullopt;
  bytes.resize(size);
  return Receive(socket, bytes.data(), size) ? std::optional(std::move(bytes)) : std::nullopt;
}

/// The child: answers each file with kSaidGlb, the name of the reader and a line break, and the GLB file, or with
/// kSaidComplaint and a complaint.
[[noreturn]] void BeReader(int socket, pid_t parent) {
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(1);  // it died before the line above
  Limit(RLIMIT_AS, MappedBytes() + kMemoryBytes);
  Limit(RLIMIT_CORE, 0);
  // What it falls on ends it, whatever the parent does on such signals.
  for (const int fatal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL, SIGXCPU}) std::signal(fatal, SIG_DFL);
  std::string missing, name;
  GlbOfFbxBytes* read = nullptr;
  if (void* module = ::dlopen(kModule, RTLD_NOW | RTLD_LOCAL); module == nullptr) {
    missing = std::string("an FBX file, for which assimp is not there (") + ::dlerror() +
              "); install Debian's libassimp-dev, and build again";
  } else if (const void* symbol = ::dlsym(module, "etude_clips_assimp"); symbol == nullptr) {
    missing = std::string(kModule) + " is no module of this program";
  } else {
    read = *static_cast<GlbOfFbxBytes* const*>(symbol);
    name = NameOfReader() + "\n";
  }
  bool is_too_long = false;
  while (const auto bytes = ReceiveBlock(socket, kLargestGlb, is_too_long)) {
    AllowProcessorTime(kProcessorSeconds);
    std::string said = missing;
    const bool went_well = read != nullptr && read(*bytes, said);
    if (!SendBlock(socket, (went_well ? kSaidGlb + name : std::string(1, kSaidComplaint)) + said)) break;
  }
  ::_exit(0);
}

}  // namespace

bool IsFbx(std::string_view bytes) { return bytes.starts_with(kBinaryStart) || bytes.starts_with(kTextStart); }

Result<FbxMotion> FbxReader::Read(std::string_view bytes, const std::string& path) {
  if (const unsigned version = MajorVersion(bytes); version > 0 && version < kOldestVersion) {
    return Fail({path}, "an FBX file of version {}; allowed: {} (of 2011 or later): export it anew, or convert it",
                version, kOldestVersion);
  }
  if (child_ < 0) {
    std::array<int, 2> ends{};
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
      return FailOfMachine("no pair of sockets can be made: {}", std::strerror(errno));
    }
    const pid_t parent = ::getpid();
    child_ = ::fork();
    if (child_ == 0) {
      ::close(ends[0]);
      BeReader(ends[1], parent);
    }
    ::close(ends[1]);
    socket_ = ends[0];
    if (child_ < 0) {
      ::close(socket_);
      return FailOfMachine("no process can be started: {}", std::strerror(errno));
    }
  }
  std::optional<std::string> said;
  bool is_too_long = false;
  if (SendBlock(socket_, bytes)) said = ReceiveBlock(socket_, kLargestGlb, is_too_long);
  if (said && said->starts_with(kSaidGlb)) {
    const std::size_t line = said->find('\n');
    return FbxMotion{.glb = said->substr(line + 1), .reader = said->substr(1, line - 1)};
  }
  if (said) {
    constexpr std::size_t kLongest = 300;  // assimp says a whole file again
    const std::string why = said->size() < 2 ? kGaveUp : said->substr(1, kLongest);
    return Fail({path}, "{}{}", why, said->size() > 1 + kLongest ? " …" : "");
  }
  const int status = End();
  const int signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  if (is_too_long || signal == SIGXCPU || signal == SIGKILL) {
    return Fail({path},
                "an FBX file too large to read: at most {} s of processor time, {} GB of memory and {} GB of result",
                kProcessorSeconds, kMemoryBytes >> 30, kLargestGlb >> 30);
  }
  if (signal == 0) return Fail({path}, "{}", kGaveUp);
  return Fail({path}, "{} {} ({})", kReaderFell, signal, ::strsignal(signal));
}

int FbxReader::End() {
  int status = 0;
  if (child_ < 0) return status;
  ::shutdown(socket_, SHUT_RDWR);  // whoever else was forked meanwhile holds it open
  ::close(socket_);
  while (::waitpid(child_, &status, 0) < 0 && errno == EINTR) {
  }
  child_ = -1;
  return status;
}

FbxReader::~FbxReader() { End(); }

Result<FbxMotion> ReadFbx(std::string_view bytes, const std::string& path) { return FbxReader().Read(bytes, path); }

}  // namespace etude
