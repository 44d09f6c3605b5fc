#include "io/process/fence.h"

#include <fmt/core.h>
#include <linux/magic.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string_view>

#include "engine/base/machine.h"
#include "io/files/file_path.h"
#include "io/process/child_process.h"
#include "io/process/control_group.h"
#include "io/process/system_call_filter.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kTrialMs = 5000;
// Kernel memory for the name and the inode of one temporary file with a long name, measured on Linux 6.18.
constexpr double kNameBytes = 700, kInodeBytes = 900;

/// Folders that every program sees: the system's programs and libraries.
constexpr std::array kSystem = {"/usr", "/bin", "/sbin", "/lib", "/lib32", "/lib64", "/libx32", "/opt", "/nix"};
/// The system's settings that every program sees: the settings of loaders, interpreters and libraries. All other
/// settings stay hidden, so that secrets, lists of users and the machine's identity are hidden even if they are added
/// later. "*" at the end matches any rest of the name.
constexpr const char* kSettings = "/etc";
constexpr std::array kShownSettings = {
    "ld.so.*",       "alternatives",   "localtime",     "timezone",  "locale.alias",
    "os-release",    "debian_version", "nsswitch.conf", "protocols", "services",
    "fonts",         "mime.types",     "magic*",        "ssl/certs", "ssl/openssl.cnf",
    "pki/tls/certs", "python*",        "java-*",        "R",         "julia*",
    "octave*",       "ImageMagick-*",  "OpenCL",        "vulkan",    "glvnd",
    "matplotlibrc",  "papersize",      "static"};
/// Scratch folders: programs may write to them; they are empty at the start.
constexpr std::array kScratch = {"/tmp", "/var/tmp", "/dev/shm"};

/// Returns true if kShownSettings contains `below` (a path relative to /etc), or a folder above `below`.
bool IsShownSetting(const fs::path& below) {
  return std::ranges::any_of(kShownSettings, [&](const std::string_view pattern) {
    if (!pattern.ends_with('*')) return IsWithin(below, pattern);
    return below.begin()->string().starts_with(pattern.substr(0, pattern.size() - 1));
  });
}

/// Lists the absolute paths of kShownSettings; names without "*" need not exist.
std::vector<fs::path> ShownSettings() {
  std::vector<fs::path> found;
  std::error_code error;
  for (const std::string_view pattern : kShownSettings) {
    if (!pattern.ends_with('*')) found.push_back(fs::path(kSettings) / pattern);
  }
  for (fs::directory_iterator entry(kSettings, error), end; !error && entry != end; entry.increment(error)) {
    const bool is_found = std::ranges::find(found, entry->path()) != found.end();
    if (!is_found && IsShownSetting(entry->path().filename())) found.push_back(entry->path());
  }
  return found;
}

void Add(std::vector<std::string>& words, std::initializer_list<std::string> more) {
  words.insert(words.end(), more.begin(), more.end());
}

/// Returns the changes that remove the names of our folders and of the user from the closed environment.
std::vector<std::string> Environment(const std::vector<fs::path>& shown) {
  std::string folders;
  const char* variable = ::getenv("PATH");
  std::istringstream words(variable != nullptr ? variable : "");
  for (std::string folder; std::getline(words, folder, ':');) {
    const bool is_seen = Fence::IsOfSystem(folder) ||
                         std::ranges::any_of(shown, [&](const fs::path& one) { return IsWithin(folder, one); });
    if (is_seen) folders += (folders.empty() ? "" : ":") + folder;
  }
  return {fmt::format("PATH={}", folders),
          fmt::format("HOME={}", kScratch[0]),
          fmt::format("TMPDIR={}", kScratch[0]),
          "USER",
          "LOGNAME",
          "SHELL"};
}

/// Returns the prlimit command that sets the thread limit. The command must run inside the fence, because the kernel
/// counts a user's threads in each namespace separately. Returns an empty list if prlimit is missing.
std::vector<std::string> Limiter(int programs) {
  const auto prlimit = FindProgram("prlimit");
  rlimit ours{};
  if (!prlimit || ::getrlimit(RLIMIT_NPROC, &ours) != 0) return {};
  const std::uint64_t threads = std::min<std::uint64_t>(ours.rlim_max, ProgramLimits::Threads(programs, ours.rlim_cur));
  return {*prlimit, fmt::format("--nproc={0}:{0}", threads), "--"};
}

/// Lists Fence::kept: sockets and named pipes (PipesBelow) and, if this process is root, files that only root can read.
/// Searches the folders in which administrators put settings and programs, and /proc (5 ms per 1000 files). In
/// /usr/share it searches only for sockets and pipes (2 ms per 1000 files).
std::vector<fs::path> KeptFromUsers() {
  const bool is_root = ::geteuid() == 0;
  std::vector<fs::path> kept;
  for (const char* root : {"/etc", "/opt", "/usr/local", "/nix/var", "/proc"}) {
    const bool is_proc = root == std::string_view("/proc");
    if (is_proc && !is_root) continue;
    std::error_code error;
    fs::recursive_directory_iterator at(root, fs::directory_options::skip_permission_denied, error), end;
    for (; !error && at != end; at.increment(error)) {
      const fs::path& path = at->path();
      // Skip processes and network settings, because a fence has processes and network settings of its own.
      const std::string name = path.filename().string();
      const bool is_process = name.find_first_not_of("0123456789") == std::string::npos || name.ends_with("self");
      if (is_proc && ((at.depth() == 0 && is_process) || path == "/proc/sys/net")) {
        at.disable_recursion_pending();
        continue;
      }
      // Collect secrets, sockets and pipes.
      std::error_code gone;
      const fs::file_status status = at->symlink_status(gone);
      if (gone || fs::is_symlink(status)) continue;
      const fs::perms needed =
          fs::is_directory(status) ? fs::perms::others_read | fs::perms::others_exec : fs::perms::others_read;
      const fs::perms permissions = status.permissions();
      const bool is_secret =
          is_root && (permissions & needed) != needed && (permissions & fs::perms::owner_read) != fs::perms::none;
      if (!is_secret && !fs::is_socket(status) && !fs::is_fifo(status)) continue;
      kept.push_back(path);
      at.disable_recursion_pending();
    }
  }
  std::ranges::move(Fence::PipesBelow("/usr/share"), std::back_inserter(kept));
  return kept;
}

/// The first process in a fence: a shell that waits for the program. It replaces bubblewrap's own first process:
/// programs inside the fence could read the memory of that process, which holds our folders' names.
constexpr const char* kFirstProcess = R"(exec 3>&2 2>/dev/null; (exec "$@" 2>&3 3>&-); exit $?)";

/// Returns the first line that a command prints in the fence, or the fence's error; "" if neither arrives within
/// kTrialMs.
std::string FirstLineOf(const Fence& fence, const std::vector<std::string>& command) {
  std::vector<std::string> words = {"-c", R"(exec "$0" "$@" 2>&1)"};
  FencedCommand fenced = fence.Around(command, {});
  words.insert(words.end(), fenced.words.begin(), fenced.words.end());
  auto child = ChildProcess::Start({.program = "sh",
                                    .arguments = std::move(words),
                                    .contained = true,
                                    .inherited_texts = std::move(fenced.inherited_texts),
                                    .environment = std::move(fenced.environment)});
  if (!child) return ToString(child.error());
  pollfd watched{child->output(), POLLIN, 0};
  for (bool open = true; open && ::poll(&watched, 1, kTrialMs) > 0;) {
    open = child->Receive();
    if (auto line = child->NextLine()) return *line;
  }
  return "";
}

}  // namespace

Fence Fence::Of(const std::string& program, std::vector<fs::path> kept, std::string groups) {
  Fence fence;
  fence.program_ = program;
  fence.kept_ = std::move(kept);
  fence.groups_ = std::move(groups);
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
  // Run `bwrap --version` inside the fence: if it answers, programs can run there.
  const std::string said = FirstLineOf(fence, {*program, "--version"});
  fence.description_ = said;
  if (said.starts_with("bubblewrap ")) {
    fence.kept_ = KeptFromUsers();
    fence.groups_ = ControlGroup::FindPlace();
    return fence;
  }
  none.description_ = fmt::format("none ({})", said.empty() ? "bubblewrap gave no reason" : said);
  return none;
}

std::string Fence::MemoryDescription() const {
  return groups_.empty() ? "measured from the memory pages of the processes, 50 times per second"
                         : "counted by the kernel (cgroup v2)";
}

Result<void> Fence::Try() const {
  if (!IsUp()) return {};
  const std::string said = FirstLineOf(*this, {program_, "--version"});
  if (said.starts_with("bubblewrap ")) return {};
  return FailOfMachine("no program can run in the sandbox (bubblewrap): {}",
                       said.empty() ? "bubblewrap gave no reason" : said);
}

ScratchUse Fence::MeasureScratch(pid_t inside) const {
  ScratchUse use;
  if (!IsUp()) return use;
  constexpr double kMb = 1 << 20;
  std::set<dev_t> seen;  // file systems already counted; folders may be on the same file system, or not mounted yet
  if (struct stat ours{}; ::stat(kScratch[0], &ours) == 0) seen.insert(ours.st_dev);
  for (const char* folder : kScratch) {
    const std::string path = fmt::format("/proc/{}/root{}", inside, folder);
    struct stat status {};
    struct statfs system {};
    if (::stat(path.c_str(), &status) != 0 || !seen.insert(status.st_dev).second) continue;
    if (::statfs(path.c_str(), &system) != 0 || system.f_type != TMPFS_MAGIC) continue;
    use.mb += static_cast<double>(system.f_blocks - system.f_bfree) * static_cast<double>(system.f_bsize) / kMb;
    const auto files = static_cast<double>(system.f_files - system.f_ffree);
    use.names_mb += files * kNameBytes / kMb;
    use.inodes_mb += files * kInodeBytes / kMb;
  }
  return use;
}

bool Fence::IsOfSystem(const fs::path& path) {
  if (std::ranges::any_of(kSystem, [&](const char* folder) { return IsWithin(path, folder); })) return true;
  return IsWithin(path, kSettings) && path != kSettings && IsShownSetting(path.lexically_relative(kSettings));
}

std::vector<fs::path> Fence::PipesBelow(const fs::path& folder) {
  std::vector<fs::path> found;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::skip_permission_denied, error), end;
  for (; !error && at != end; at.increment(error)) {
    std::error_code gone;
    const fs::file_type type = at->symlink_status(gone).type();
    if (type == fs::file_type::socket || type == fs::file_type::fifo) found.push_back(at->path());
  }
  return found;
}

bool Fence::HoldsScratch(const fs::path& folder) {
  return std::ranges::any_of(kScratch, [&](const char* scratch) { return IsWithin(scratch, folder); });
}

FencedCommand Fence::Around(const std::vector<std::string>& command, const std::vector<fs::path>& shown,
                            const fs::path& start) const {
  if (!IsUp()) return {command};
  FencedCommand fenced{{program_, "--args", "3", "--", "/bin/sh", "-c", kFirstProcess, "sh"}, {""}, Environment(shown)};
  const auto pass_text = [&](std::string text) {  // returns the number of the text's file descriptor
    fenced.inherited_texts.push_back(std::move(text));
    return std::to_string(fenced.inherited_texts.size() + 2);
  };
  // Add namespaces and privileges.
  std::vector<std::string> words = {"--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-net"};
  Add(words, {"--unshare-uts", "--unshare-cgroup-try", "--disable-userns", "--cap-drop", "ALL"});
  Add(words, {"--new-session", "--die-with-parent", "--as-pid-1", "--proc", "/proc", "--tmpfs", "/dev"});
  // Add devices. Bubblewrap's --dev would also add terminals (/dev/pts), which come from one limited pool of the whole
  // machine.
  for (const char* device : {"/dev/null", "/dev/zero", "/dev/full", "/dev/random", "/dev/urandom", "/dev/tty"}) {
    Add(words, {"--dev-bind-try", device, device});
  }
  Add(words, {"--symlink", "/proc/self/fd", "/dev/fd", "--symlink", "/proc/self/fd/0", "/dev/stdin"});
  Add(words, {"--symlink", "/proc/self/fd/1", "/dev/stdout", "--symlink", "/proc/self/fd/2", "/dev/stderr"});
  Add(words, {"--ro-bind-try", "/sys/devices/system", "/sys/devices/system"});
  // Add scratch folders, and the visible part of the system.
  const std::string scratch_bytes = std::to_string(ProgramLimits::kFileBytes);
  for (const char* folder : kScratch) Add(words, {"--size", scratch_bytes, "--tmpfs", folder});
  Add(words, {"--dir", "/run"});
  std::error_code error;
  for (const char* folder : kSystem) {
    const bool is_link = fs::is_symlink(folder, error);
    const std::string target = is_link ? fs::read_symlink(folder, error).string() : folder;
    Add(words, {is_link ? "--symlink" : "--ro-bind-try", target, folder});
  }
  for (const fs::path& setting : ShownSettings()) {
    const bool is_link = fs::is_symlink(setting, error) && IsOfSystem(fs::weakly_canonical(setting, error));
    const std::string target = is_link ? fs::read_symlink(setting, error).string() : setting.string();
    Add(words, {is_link ? "--symlink" : "--ro-bind-try", target, setting.string()});
  }
  // Add a list of users and a list of groups. Each list contains only the present user or group, under the name "user".
  Add(words, {"--file", pass_text(fmt::format("user:x:{}:{}::{}:/bin/sh\n", ::geteuid(), ::getegid(), kScratch[0]))});
  Add(words, {"/etc/passwd", "--file", pass_text(fmt::format("user:x:{}:\n", ::getegid())), "/etc/group"});
  // Collect shown and hidden paths, sorted, so that a folder comes before its contents. Only visible paths are hidden,
  // because masking an invisible path would reveal its name.
  std::map<fs::path, bool> is_shown;
  for (const fs::path& path : shown) is_shown.emplace(path, true);
  const auto is_within_shown = [&](const fs::path& path) {
    return std::ranges::any_of(shown, [&](const fs::path& one) { return IsWithin(path, one); });
  };
  for (const fs::path& path : hidden_) {
    const bool is_seen = IsOfSystem(path) || (is_within_shown(path) && !HoldsScratch(path));
    if (is_seen && fs::exists(path, error)) is_shown.insert_or_assign(path, false);
  }
  for (const fs::path& path : kept_) {
    const bool is_seen = IsOfSystem(path) || IsWithin(path, "/proc");
    if (is_seen && !is_within_shown(path) && fs::exists(path, error)) is_shown.emplace(path, false);
  }
  // Mask hidden folders with empty folders. The masks become read-only after everything below them is mounted.
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
  Add(words, {"--chdir", start.empty() ? kScratch[0] : start.string()});
  // Add the system call filter; then pass all arguments as a text on descriptor 3.
  std::string filter = SystemCallFilter();
  if (!filter.empty()) Add(words, {"--seccomp", pass_text(std::move(filter))});
  for (const char* folder : {"/dev", "/proc", "/"}) Add(words, {"--remount-ro", folder});
  for (const std::string& word : words) fenced.inherited_texts[0] += word + '\0';
  const std::vector<std::string> limiter = Limiter(programs_);
  fenced.words.insert(fenced.words.end(), limiter.begin(), limiter.end());
  fenced.words.insert(fenced.words.end(), command.begin(), command.end());
  return fenced;
}

}  // namespace etude
