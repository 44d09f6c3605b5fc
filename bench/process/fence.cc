#include "bench/process/fence.h"

#include <fmt/core.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/magic.h>
#include <linux/seccomp.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <sys/syscall.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>

#include "bench/process/child_process.h"
#include "engine/base/machine.h"

namespace etude {
namespace {

#if defined(__x86_64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_X86_64;
#elif defined(__aarch64__)
constexpr std::uint32_t kArchitecture = AUDIT_ARCH_AARCH64;
#else
constexpr std::uint32_t kArchitecture = 0;
#endif

constexpr std::array kRefused = {SYS_memfd_create, SYS_memfd_secret, SYS_shmget, SYS_msgget,
                                 SYS_add_key,      SYS_request_key,  SYS_keyctl, SYS_io_uring_setup};
constexpr std::array kFamilies = {AF_UNIX, AF_INET, AF_INET6, AF_NETLINK};
constexpr std::uint32_t kOtherNumbers = 0x40000000;  // from here on the x32 ABI's, on x86-64; nobody's elsewhere

constexpr sock_filter Load(std::size_t offset) {
  return BPF_STMT(BPF_LD | BPF_W | BPF_ABS, static_cast<std::uint32_t>(offset));
}
constexpr sock_filter Return(std::uint32_t what) { return BPF_STMT(BPF_RET | BPF_K, what); }
constexpr sock_filter SkipUnless(std::uint16_t test, std::uint32_t value, std::uint8_t count) {
  return BPF_JUMP(static_cast<std::uint16_t>(BPF_JMP | test | BPF_K), value, 0, count);
}

/// A filter of system calls for programs that are not ours, as the kernel takes it (a seccomp BPF program): refuses
/// memory that no look at processes and folders sees (memfd_create, SysV shared memory and queues), sockets of other
/// families than UNIX, INET, INET6 and NETLINK, which no network namespace closes (AF_VSOCK speaks to the host), keys
/// of the user's, and io_uring, which does all of these without system calls. "" where it is not known for this CPU.
std::string SystemCallFilter() {
  if (kArchitecture == 0) return "";
  const sock_filter refuse = Return(SECCOMP_RET_ERRNO | ENOSYS), allow = Return(SECCOMP_RET_ALLOW);
  std::vector<sock_filter> filter = {Load(offsetof(seccomp_data, arch)),
                                     BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, kArchitecture, 1, 0),
                                     refuse,
                                     Load(offsetof(seccomp_data, nr)),
                                     SkipUnless(BPF_JGE, kOtherNumbers, 1),
                                     refuse};
  for (const auto number : kRefused) {
    filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(number), 1));
    filter.push_back(refuse);
  }
  for (const auto number : {SYS_socket, SYS_socketpair}) {
    filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(number), 2 * kFamilies.size() + 2));
    filter.push_back(Load(offsetof(seccomp_data, args)));  // its lower half: both CPUs are little-endian
    for (const int family : kFamilies) {
      filter.push_back(SkipUnless(BPF_JEQ, static_cast<std::uint32_t>(family), 1));
      filter.push_back(allow);
    }
    filter.push_back(Return(SECCOMP_RET_ERRNO | EAFNOSUPPORT));
  }
  filter.push_back(allow);
  return {reinterpret_cast<const char*>(filter.data()), filter.size() * sizeof(sock_filter)};
}

namespace fs = std::filesystem;

constexpr int kTrialMs = 5000;

/// The folders that every program sees: the system's programs, libraries and settings.
constexpr std::array kSystem = {"/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/etc", "/opt", "/nix"};
/// Folders to write to, empty at first.
constexpr std::array kScratch = {"/tmp", "/var/tmp", "/dev/shm"};

bool IsWithin(const fs::path& path, const fs::path& folder) {
  const auto [at_folder, at_path] = std::ranges::mismatch(folder, path);
  return at_folder == folder.end();
}

void Add(std::vector<std::string>& words, std::initializer_list<std::string> more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// Sets the one limit that must be set inside: the kernel counts a user's threads by namespace.
std::vector<std::string> Limiter() {
  const auto prlimit = FindProgram("prlimit");
  rlimit ours{};
  if (!prlimit || ::getrlimit(RLIMIT_NPROC, &ours) != 0) return {};
  const std::uint64_t threads = std::min<std::uint64_t>(ours.rlim_max, ProgramLimits::kThreads);
  return {*prlimit, fmt::format("--nproc={0}:{0}", threads), "--"};
}

/// The first line that a fenced command says, a refusal of the fence among them; "" when it says none in time.
std::string FirstLineOf(const Fence& fence, const std::vector<std::string>& command) {
  std::vector<std::string> words = {"-c", R"(exec "$0" "$@" 2>&1)"};
  FencedCommand fenced = fence.Around(command, {});
  words.insert(words.end(), fenced.words.begin(), fenced.words.end());
  auto child = ChildProcess::Start(
      {.program = "sh", .arguments = std::move(words), .contained = true, .told = std::move(fenced.told)});
  if (!child) return ToString(child.error());
  pollfd watched{child->output(), POLLIN, 0};
  for (bool open = true; open && ::poll(&watched, 1, kTrialMs) > 0;) {
    open = child->Receive();
    if (auto line = child->NextLine()) return *line;
  }
  return "";
}

}  // namespace

Fence Fence::Of(const std::string& program) {
  Fence fence;
  fence.program_ = program;
  return fence;
}

Fence Fence::Find() {
  Fence none;
  const auto program = FindProgram("bwrap");
  if (!program) {
    none.description_ = "none (bubblewrap is not installed)";
    return none;
  }
  Fence fence = Of(*program);
  // It tells its version from within the whole fence.
  const std::string said = FirstLineOf(fence, {*program, "--version"});
  fence.description_ = said;
  if (said.starts_with("bubblewrap ")) return fence;
  none.description_ = fmt::format("none ({})", said.empty() ? "bubblewrap says nothing" : said);
  return none;
}

Result<void> Fence::Try() const {
  if (!IsUp()) return {};
  const std::string said = FirstLineOf(*this, {program_, "--version"});
  if (said.starts_with("bubblewrap ")) return {};
  return Fail({kThisMachine}, "nothing can be run in the fence: {}", said.empty() ? "it says nothing" : said);
}

double Fence::ScratchMb(pid_t inside) const {
  if (!IsUp()) return 0;
  double bytes = 0;
  std::set<dev_t> seen;  // a folder may be one with another, or not be there yet
  if (struct stat ours{}; ::stat(kScratch[0], &ours) == 0) seen.insert(ours.st_dev);
  for (const char* folder : kScratch) {
    const std::string path = fmt::format("/proc/{}/root{}", inside, folder);
    struct stat status {};
    struct statfs system {};
    if (::stat(path.c_str(), &status) != 0 || !seen.insert(status.st_dev).second) continue;
    if (::statfs(path.c_str(), &system) != 0 || system.f_type != TMPFS_MAGIC) continue;
    bytes += static_cast<double>(system.f_blocks - system.f_bfree) * static_cast<double>(system.f_bsize);
  }
  return bytes / (1 << 20);
}

bool Fence::IsOfSystem(const fs::path& path) {
  return std::ranges::any_of(kSystem, [&](const char* folder) { return IsWithin(path, folder); });
}

bool Fence::HoldsScratch(const fs::path& folder) {
  return std::ranges::any_of(kScratch, [&](const char* scratch) { return IsWithin(scratch, folder); });
}

FencedCommand Fence::Around(const std::vector<std::string>& command, const std::vector<fs::path>& shown,
                            const fs::path& start) const {
  if (!IsUp()) return {command};
  std::vector<std::string> words = {"--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-net"};
  Add(words, {"--unshare-uts", "--unshare-cgroup-try", "--disable-userns", "--cap-drop", "ALL"});
  Add(words, {"--new-session", "--die-with-parent", "--dev", "/dev", "--proc", "/proc"});
  Add(words, {"--ro-bind-try", "/sys/devices/system", "/sys/devices/system"});
  const std::string scratch_bytes = std::to_string(ProgramLimits::kFileBytes);
  for (const char* folder : kScratch) Add(words, {"--size", scratch_bytes, "--tmpfs", folder});
  Add(words, {"--dir", "/run", "--setenv", "TMPDIR", kScratch[0], "--setenv", "HOME", kScratch[0]});
  std::error_code error;
  for (const char* folder : kSystem) {
    const bool is_link = fs::is_symlink(folder, error);
    const std::string target = is_link ? fs::read_symlink(folder, error).string() : folder;
    Add(words, {is_link ? "--symlink" : "--ro-bind-try", target, folder});
  }
  // In this order a folder comes before what it holds. What lies in no folder that is seen needs no hiding, which would
  // tell its name.
  std::map<fs::path, bool> is_shown;
  for (const fs::path& path : shown) is_shown.emplace(path, true);
  for (const fs::path& path : hidden_) {
    const bool is_seen = IsOfSystem(path) || std::ranges::any_of(shown, [&](const fs::path& one) {
                           return IsWithin(path, one) && !HoldsScratch(path);
                         });
    if (is_seen && fs::exists(path, error)) is_shown.insert_or_assign(path, false);
  }
  std::vector<std::string> masks;
  for (const auto& [path, is_seen] : is_shown) {
    if (is_seen) {
      Add(words, {"--ro-bind", path.string(), path.string()});
    } else if (fs::is_directory(path, error)) {
      Add(words, {"--tmpfs", path.string()});
      Add(masks, {"--remount-ro", path.string()});
    } else {
      Add(words, {"--ro-bind", "/dev/null", path.string()});
    }
  }
  words.insert(words.end(), masks.begin(), masks.end());
  Add(words, {"--remount-ro", "/dev", "--remount-ro", "/", "--chdir", start.empty() ? kScratch[0] : start.string()});
  std::string filter = SystemCallFilter();
  if (!filter.empty()) Add(words, {"--seccomp", "4"});
  FencedCommand fenced{{program_, "--args", "3", "--"}, {""}};
  for (const std::string& word : words) fenced.told[0] += word + '\0';
  if (!filter.empty()) fenced.told.push_back(std::move(filter));
  const std::vector<std::string> limiter = Limiter();
  fenced.words.insert(fenced.words.end(), limiter.begin(), limiter.end());
  fenced.words.insert(fenced.words.end(), command.begin(), command.end());
  return fenced;
}

}  // namespace etude
