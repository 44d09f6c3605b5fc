#include "io/process/control_group.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sstream>
#include <string_view>

#include "io/process/child_process.h"

namespace etude {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "etude-";  // followed by the ID of the process that made the group, and a counter
constexpr int kMaxEndingMs = 100;               // maximum wait for the last process to leave a group

bool Write(const fs::path& file, std::string_view text) {
  const Descriptor opened(::open(file.c_str(), O_WRONLY | O_CLOEXEC));
  return opened.number() >= 0 &&
         ::write(opened.number(), text.data(), text.size()) == static_cast<ssize_t>(text.size());
}

bool HasWord(const std::string& text, std::string_view wanted) {
  std::istringstream words(text);
  for (std::string word; words >> word;) {
    if (word == wanted) return true;
  }
  return false;
}

/// Returns true if groups below a folder count memory, and this user may make groups there and start processes in them.
bool IsPlace(const fs::path& folder) {
  return HasWord(ReadProcFile((folder / "cgroup.subtree_control").string()), "memory") &&
         ::access(folder.c_str(), W_OK) == 0 && ::access((folder / "cgroup.procs").c_str(), W_OK) == 0;
}

/// Makes this process's own group usable (IsPlace), if no other process is in this group. Moves this process into a
/// child group, because a group that passes controllers on to child groups may not contain processes.
bool MakePlaceOf(const fs::path& own) {
  const fs::path below = own / fmt::format("{}{}", kPrefix, ::getpid());
  std::error_code error;
  if (!HasWord(ReadProcFile((own / "cgroup.controllers").string()), "memory") || !fs::create_directory(below, error))
    return false;
  const std::string we = std::to_string(::getpid());
  if (Write(below / "cgroup.procs", we)) {
    if (Write(own / "cgroup.subtree_control", "+memory +pids") || Write(own / "cgroup.subtree_control", "+memory"))
      return true;
    Write(own / "cgroup.procs", we);
  }
  fs::remove(below, error);
  return false;
}

/// Removes the groups of processes that have ended. The kernel refuses to remove groups that still contain processes.
void RemoveLeftGroups(const fs::path& place) {
  std::error_code error;
  for (const fs::directory_entry& entry : fs::directory_iterator(place, error)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with(kPrefix)) continue;
    const int maker = std::atoi(name.c_str() + kPrefix.size());
    if (maker > 0 && ::kill(maker, 0) != 0 && errno == ESRCH) ::rmdir(entry.path().c_str());
  }
}

double NumberOf(const std::string& text, std::string_view name) {
  const std::string start = fmt::format("\n{} ", name);
  const std::size_t at = text.find(start);
  return at == std::string::npos ? 0 : std::strtod(text.c_str() + at + start.size(), nullptr);
}

}  // namespace

OwnGroup OwnGroup::Read(const std::string& groups, const std::string& mounts) {
  std::istringstream group_lines(groups), mount_lines(mounts);
  std::string own;
  for (std::string line; std::getline(group_lines, line);) {
    if (line.starts_with("0::/")) own = line.substr(3);
  }
  for (std::string line; !own.empty() && std::getline(mount_lines, line);) {
    // A line looks like "36 24 0:30 / /sys/fs/cgroup rw,nosuid - cgroup2 cgroup2 rw".
    if (line.find(" - cgroup2 ") == std::string::npos) continue;
    std::istringstream words(line);
    std::string number, parent, device, root, mount;
    words >> number >> parent >> device >> root >> mount;
    const std::string start = root == "/" ? "" : root;
    const bool is_below = own.starts_with(start) && (own.size() == start.size() || own[start.size()] == '/');
    if (!is_below) continue;
    std::string folder = fs::path(mount + own.substr(start.size())).lexically_normal().string();
    if (folder.size() > 1 && folder.ends_with('/')) folder.pop_back();
    return {std::move(folder), mount};
  }
  return {};
}

double HeldMbIn(const std::string& memory_stat, const std::string& swapped) {
  const std::string stat = "\n" + memory_stat;
  double bytes =
      NumberOf(stat, "anon") + NumberOf(stat, "shmem") + NumberOf(stat, "sock") + std::strtod(swapped.c_str(), nullptr);
  if (const double kernel = NumberOf(stat, "kernel"); kernel > 0) {
    bytes += kernel - NumberOf(stat, "slab_reclaimable");
  } else {  // Linux before 5.18 states only the parts of the kernel's memory
    for (const char* part : {"kernel_stack", "pagetables", "percpu", "slab_unreclaimable"})
      bytes += NumberOf(stat, part);
  }
  return bytes / (1 << 20);
}

std::string ControlGroup::FindPlace() {
  return FindPlace(OwnGroup::Read(ReadProcFile("/proc/self/cgroup"), ReadProcFile("/proc/self/mountinfo")));
}

std::string ControlGroup::FindPlace(const OwnGroup& of_process) {
  const fs::path own = of_process.folder, top = of_process.top;
  if (own.empty()) return "";
  fs::path place;
  if (IsPlace(own) || MakePlaceOf(own)) place = own;
  for (fs::path above = own; place.empty() && above != top && above.has_relative_path();) {
    above = above.parent_path();
    if (IsPlace(above)) place = above;
  }
  if (!place.empty()) RemoveLeftGroups(place);
  return place.string();
}

ControlGroup ControlGroup::Make(const std::string& place, double max_mb) {
  static int made = 0;
  ControlGroup group;
  if (place.empty()) return group;
  group.path_ = fmt::format("{}/{}{}-{}", place, kPrefix, ::getpid(), ++made);
  std::error_code error;
  if (!fs::create_directory(group.path_, error)) return {};
  // WatchedProgram enforces `max_mb` at each sample; the kernel's higher limit stops faster growth.
  const double max_bytes = (1.25 * max_mb + 64) * (1 << 20);
  const bool is_limited = Write(group.path_ + "/memory.max", fmt::format("{:.0f}", max_bytes)) &&
                          Write(group.path_ + "/memory.oom.group", "1");
  Write(group.path_ + "/pids.max", std::to_string(ProgramLimits::kThreads));
  group.folder_ = Descriptor(is_limited ? ::open(group.path_.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1);
  if (!group.IsUp()) ::rmdir(group.path_.c_str());
  return group;
}

ControlGroup& ControlGroup::operator=(ControlGroup&& other) noexcept {
  if (this != &other) {
    Remove();
    path_ = std::move(other.path_);
    folder_ = std::move(other.folder_);
  }
  return *this;
}

double ControlGroup::HeldMb() const { return HeldMbIn(Read("memory.stat"), Read("memory.swap.current")); }

bool ControlGroup::WasFull() const {
  const std::string events = "\n" + Read("memory.events");
  return NumberOf(events, "oom_kill") > 0;
}

std::string ControlGroup::Read(const char* name) const { return ReadProcFile(fmt::format("{}/{}", path_, name)); }

void ControlGroup::Remove() {
  if (!IsUp()) return;
  folder_.Close();
  for (int i = 0; i < kMaxEndingMs && ::rmdir(path_.c_str()) != 0 && errno == EBUSY; ++i) ::usleep(1000);
}

}  // namespace etude
