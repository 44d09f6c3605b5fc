#include "bench/process/fence.h"

#include <fmt/core.h>
#include <poll.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <set>

#include "bench/process/child_process.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr int kTrialMs = 5000;

/// Replaced by folders to write to: what others keep there is none of its business.
constexpr std::array kScratch = {"/tmp", "/var/tmp", "/dev/shm"};
/// Holds the sockets of the system's services, which a network namespace does not close.
constexpr const char* kSockets = "/run";

bool IsFolder(const fs::path& path) {
  std::error_code error;
  return fs::is_directory(fs::symlink_status(path, error));
}

/// The part of a path just below the replaced folder that it lies in; else "".
fs::path TopBelowReplaced(const fs::path& path) {
  for (const char* replaced : {kScratch[0], kScratch[1], kScratch[2], kSockets}) {
    const fs::path inside = path.lexically_relative(replaced);
    if (!inside.empty() && *inside.begin() != ".." && *inside.begin() != ".") return replaced / *inside.begin();
  }
  return {};
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

/// The first line that a command says; "" when it says none in time.
std::string FirstLineOf(const std::vector<std::string>& command) {
  auto child = ChildProcess::Start({.program = command[0], .arguments = {command.begin() + 1, command.end()}});
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
  const auto program = FindProgram("bwrap"), shell = FindProgram("sh");
  if (!program || !shell) {
    none.description_ = "none (bubblewrap is not installed)";
    return none;
  }
  Fence fence = Of(*program);
  // It tells its version from within the whole fence. A refusal is told on standard error.
  std::vector<std::string> trial = {*shell, "-c", R"(exec "$0" "$@" 2>&1)"};
  const std::vector<std::string> fenced = fence.Around({*program, "--version"}, {});
  trial.insert(trial.end(), fenced.begin(), fenced.end());
  const std::string said = FirstLineOf(trial);
  fence.description_ = said;
  if (said.starts_with("bubblewrap ")) return fence;
  none.description_ = fmt::format("none ({})", said.empty() ? "bubblewrap says nothing" : said);
  return none;
}

std::vector<std::string> Fence::Around(const std::vector<std::string>& command,
                                       const std::vector<fs::path>& shown) const {
  if (!IsUp()) return command;
  std::vector<std::string> words = {program_};
  Add(words, {"--unshare-user", "--unshare-pid", "--unshare-ipc", "--unshare-net", "--unshare-uts"});
  Add(words, {"--unshare-cgroup-try", "--disable-userns", "--cap-drop", "ALL", "--new-session", "--die-with-parent"});
  Add(words, {"--ro-bind", "/", "/", "--dev", "/dev", "--proc", "/proc"});
  const std::string scratch_bytes = std::to_string(ProgramLimits::kFileBytes);
  for (const char* folder : kScratch) {
    if (IsFolder(folder)) Add(words, {"--size", scratch_bytes, "--tmpfs", folder});
  }
  Add(words, {"--remount-ro", "/dev", "--tmpfs", kSockets, "--setenv", "TMPDIR", kScratch[0]});

  std::error_code error;
  const fs::path here = fs::current_path(error);
  std::set<fs::path> seen(shown.begin(), shown.end());
  seen.insert(TopBelowReplaced(here));
  for (const std::string& word : command) {
    const fs::path path = (here / word).lexically_normal();
    if (fs::exists(path, error)) seen.insert(TopBelowReplaced(path));
  }
  for (const fs::path& path : seen) {
    if (!path.empty()) Add(words, {"--ro-bind", path.string(), path.string()});
  }
  for (const fs::path& folder : hidden_) {
    const bool holds_here = *here.lexically_relative(folder).begin() != "..";  // it must be seen then
    if (!holds_here) Add(words, {"--tmpfs", folder.string(), "--remount-ro", folder.string()});
  }
  Add(words, {"--remount-ro", kSockets, "--chdir", here.string(), "--"});
  const std::vector<std::string> limiter = Limiter();
  words.insert(words.end(), limiter.begin(), limiter.end());
  words.insert(words.end(), command.begin(), command.end());
  return words;
}

}  // namespace etude
