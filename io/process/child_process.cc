#include "io/process/child_process.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <linux/sched.h>
#include <poll.h>
#include <sched.h>
#include <signal.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>
#include <utility>

#include "engine/base/machine.h"
#include "io/process/closed_environment.h"

namespace etude {
namespace {

bool IsProgram(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

constexpr int kChunksPerReceive = 16;  // at most 64 KiB each; the limit ends Receive even if a child writes endlessly

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

constexpr int kNotContained = -1;  // reported instead of an errno if the namespaces cannot be set up

struct Pipe {
  Descriptor read, write;
};

Result<Pipe> MakePipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0)
    return FailOfMachine("Etude cannot create a pipe: {}", std::strerror(errno));
  return Pipe{Descriptor(ends[0]), Descriptor(ends[1])};
}

void Limit(__rlimit_resource resource, rlim_t maximum) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_max = std::min(limit.rlim_max, maximum);
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  ::setrlimit(resource, &limit);
}

void LimitProgram() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  Limit(RLIMIT_FSIZE, ProgramLimits::kFileBytes);
  Limit(RLIMIT_NOFILE, ProgramLimits::kOpenFiles);
  Limit(RLIMIT_SIGPENDING, ProgramLimits::kPendingSignals);
  Limit(RLIMIT_MEMLOCK, ProgramLimits::kLockedBytes);
  Limit(RLIMIT_MSGQUEUE, 0);
  Limit(RLIMIT_CORE, 1);  // at 0 the kernel would still start a core dump helper
}

/// All that a forked child needs for exec, prepared before the fork: between fork and exec only system calls are safe.
struct ExecPlan {
  const char* path;
  char* const* argv;
  char* const* envp;
  int input, output, errors;  ///< descriptors; `errors` is −1 if the child uses our standard error
  int report;                 ///< a pipe to which the child writes the errno of a failure
  int parent;                 ///< a pidfd of this process
  bool limited, contained;
  std::string user_map, group_map;
  std::vector<Descriptor> texts;
  /// Files in /proc, and the text that is written to each file.
  std::vector<std::pair<const char*, std::string>> user_limits;
};

/// Forks into new user, PID and mount namespaces, and into a control group (−1 = none). In its namespaces, the child
/// has the privileges that bubblewrap needs.
pid_t ForkContained(int control_group) {
  clone_args how{};
  how.flags = CLONE_NEWUSER | CLONE_NEWPID | CLONE_NEWNS;
  how.exit_signal = SIGCHLD;
  if (control_group >= 0) {
    how.flags |= CLONE_INTO_CGROUP;
    how.cgroup = static_cast<std::uint64_t>(control_group);
  }
  return static_cast<pid_t>(::syscall(SYS_clone3, &how, sizeof how));
}

bool WriteTo(const char* path, std::string_view text) {
  const int file = ::open(path, O_WRONLY | O_CLOEXEC);
  const bool written = file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  if (file >= 0) ::close(file);
  return written;
}

/// Sets up the new namespaces as bubblewrap expects: the same user and group IDs, and a separate /proc. Sets the
/// kernel's limits per user for the namespace, so that the program cannot use up the limits of the user's programs.
bool SetUpNamespaces(const ExecPlan& child) {
  const bool is_set_up = WriteTo("/proc/self/setgroups", "deny") && WriteTo("/proc/self/uid_map", child.user_map) &&
                         WriteTo("/proc/self/gid_map", child.group_map) &&
                         ::mount("proc", "/proc", "proc", MS_NOSUID | MS_NODEV | MS_NOEXEC, nullptr) == 0;
  if (!is_set_up || !child.limited) return is_set_up;
  for (const auto& [file, text] : child.user_limits) WriteTo(file, text);
  return true;
}

[[noreturn]] void GiveUp(const ExecPlan& child, int reason) {
  if (::write(child.report, &reason, sizeof reason) < 0) ::_exit(126);
  ::_exit(127);
}

[[noreturn]] void BecomeProgram(const ExecPlan& child) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // the child adopts the orphans among its descendants
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd parent{child.parent, POLLIN, 0};
  if (::poll(&parent, 1, 0) != 0) ::_exit(0);  // the parent died before PR_SET_PDEATHSIG was set
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGCHLD, SIGXFSZ}) ::signal(number, SIG_DFL);
  if (child.contained && !SetUpNamespaces(child)) GiveUp(child, kNotContained);
  if (child.limited) LimitProgram();
  ::dup2(child.input, STDIN_FILENO);
  ::dup2(child.output, STDOUT_FILENO);
  if (child.errors >= 0) ::dup2(child.errors, STDERR_FILENO);
  ::close_range(STDERR_FILENO + 1, ~0U, CLOSE_RANGE_CLOEXEC);
  for (std::size_t i = 0; i < child.texts.size(); ++i) {
    const int wanted = STDERR_FILENO + 1 + static_cast<int>(i);
    // The texts were opened after three pipes, so each text has a higher descriptor than the target descriptor to which
    // it is copied, and no target overwrites a text that is still to be copied.
    if (::dup2(child.texts[i].number(), wanted) < 0 || ::lseek(wanted, 0, SEEK_SET) != 0) GiveUp(child, errno);
  }
  ::execve(child.path, child.argv, child.envp);
  GiveUp(child, errno);
}

Result<Descriptor> MakeFile(const std::string& text) {
  Descriptor file(::memfd_create("text", MFD_CLOEXEC));
  if (file.number() < 0 || ::write(file.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
    return FailOfMachine("Etude cannot create a file in memory: {}", std::strerror(errno));
  }
  return file;
}

/// Sets (NAME=VALUE) or removes (NAME) a variable of an environment.
void Change(std::vector<std::string>& environment, const std::string& change) {
  const std::string start = change.substr(0, change.find('=')) + "=";
  std::erase_if(environment, [&](const std::string& text) { return text.starts_with(start); });
  if (change.size() >= start.size()) environment.push_back(change);
}

Result<ChildProcess> StartUncontained(ChildOptions options) {
  options.contained = false;
  return ChildProcess::Start(options);
}

/// Returns the children of this process that ChildProcess started. After AdoptOrphans, all other children are orphans.
std::set<pid_t>& ManagedChildren() {
  static std::set<pid_t> children;
  return children;
}

/// Kills adopted orphans, if this process adopts any (AdoptOrphans).
void EndOrphans() {
  int adopts = 0;
  ::prctl(PR_GET_CHILD_SUBREAPER, &adopts);
  if (adopts == 0) return;
  constexpr int kMaxPasses = 100;  // killing an orphan may make its children orphans
  bool found = true;
  for (int i = 0; found && i < kMaxPasses; ++i) {
    found = false;
    for (const pid_t child : ChildrenOf(::getpid())) {
      if (ManagedChildren().contains(child)) continue;
      found = true;
      HeldTree(child).Kill();
      ::waitpid(child, nullptr, 0);
    }
  }
}

/// Returns the exit code as shells and bubblewrap report it: 128 + n for signal n.
int ExitCode(int status) { return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status); }

std::string DescribeEnd(int code) {
  const int signal = code - 128;
  if (signal <= 0 || signal >= NSIG) return fmt::format("exit code {}", code);
  return fmt::format("signal {} ({})", signal, strsignal(signal));
}

}  // namespace

Result<std::string> FindProgram(const std::string& name) {
  if (name.find('/') != std::string::npos) {
    if (::access(name.c_str(), F_OK) != 0) return Fail({name, 0, 0}, "no such program: {}", std::strerror(errno));
    if (!IsProgram(name)) return Fail({name, 0, 0}, "this file is not an executable program");
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

void AdoptOrphans() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

Result<ChildProcess> ChildProcess::Start(const ChildOptions& options) {
  // Open the pipes, and the file for standard error.
  ASSIGN_OR_RETURN(const auto path, FindProgram(options.program));
  auto input = MakePipe(), output = MakePipe(), report = MakePipe();
  for (const auto* pipe : {&input, &output, &report}) {
    if (!*pipe) return tl::unexpected(pipe->error());
  }
  Descriptor errors;
  if (!options.error_file.empty()) {
    errors = Descriptor(::open(options.error_file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
    if (errors.number() < 0) return CannotWrite(options.error_file, "cannot write", errno);
  }
  // Prepare all that the child needs after the fork.
  std::vector<std::string> argument_texts = {options.program};
  argument_texts.insert(argument_texts.end(), options.arguments.begin(), options.arguments.end());
  std::vector<std::string> environment_texts = ClosedEnvironment();
  if (options.limited) Change(environment_texts, "PWD");
  for (const std::string& change : options.environment) Change(environment_texts, change);
  const std::vector<char*> argv = Pointers(argument_texts);
  const std::vector<char*> envp = Pointers(environment_texts);
  const Descriptor ourselves(static_cast<int>(::syscall(SYS_pidfd_open, ::getpid(), 0)));
  if (ourselves.number() < 0) return FailOfMachine("Etude cannot watch the process: {}", std::strerror(errno));
  ExecPlan child{
      .path = path.c_str(),
      .argv = argv.data(),
      .envp = envp.data(),
      .input = input->read.number(),
      .output = output->write.number(),
      .errors = errors.number(),
      .report = report->write.number(),
      .parent = ourselves.number(),
      .limited = options.limited,
      .contained = options.contained,
      .user_map = fmt::format("{0} {0} 1", ::geteuid()),
      .group_map = fmt::format("{0} {0} 1", ::getegid()),
      .texts = {},
      .user_limits = {
          {"/proc/sys/user/max_inotify_instances", std::to_string(ProgramLimits::InotifyInstances(options.programs))},
          {"/proc/sys/user/max_inotify_watches", std::to_string(ProgramLimits::kInotifyWatches)}}};
  for (const std::string& text : options.inherited_texts) {
    ASSIGN_OR_RETURN(auto file, MakeFile(text));
    child.texts.push_back(std::move(file));
  }
  // Fork. If the kernel refuses the control group or the namespaces, continue without them.
  ::signal(SIGPIPE, SIG_IGN);
  pid_t pid = options.contained ? ForkContained(options.control_group) : ::fork();
  if (pid < 0 && options.control_group >= 0) pid = ForkContained(-1);
  if (pid == 0) BecomeProgram(child);
  if (pid < 0 && options.contained && errno != EAGAIN && errno != ENOMEM) return StartUncontained(options);
  if (pid < 0) return FailOfMachine("Etude cannot start a process: {}", std::strerror(errno));
  // Wait until the child has executed the program (the pipe closes) or reports why not.
  ManagedChildren().insert(pid);
  report->write.Close();
  int reason = 0;
  ssize_t count = 0;
  while ((count = ::read(report->read.number(), &reason, sizeof reason)) < 0 && errno == EINTR) {
  }
  if (count > 0) {
    ::waitpid(pid, nullptr, 0);
    ManagedChildren().erase(pid);
    if (reason == kNotContained) return StartUncontained(options);
    return Fail({path, 0, 0}, "cannot be executed: {}", std::strerror(reason));
  }
  ::fcntl(input->write.number(), F_SETFL, O_NONBLOCK);
  ::fcntl(output->read.number(), F_SETFL, O_NONBLOCK);
  return ChildProcess(pid, input->write.Release(), output->read.Release());
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept { *this = std::move(other); }

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this != &other) {
    Finish();
    pid_ = std::exchange(other.pid_, -1);
    input_ = std::exchange(other.input_, -1);
    output_ = std::exchange(other.output_, -1);
    broken_by_ = std::exchange(other.broken_by_, 0);
    exit_code_ = std::exchange(other.exit_code_, -1);
    unsent_ = std::move(other.unsent_);
    sent_ = std::exchange(other.sent_, 0);
    buffer_ = std::move(other.buffer_);
    line_start_ = std::exchange(other.line_start_, 0);
    scanned_ = std::exchange(other.scanned_, 0);
  }
  return *this;
}

ChildProcess::~ChildProcess() { Finish(); }

bool ChildProcess::Send(const std::string& line) {
  unsent_.erase(0, sent_);
  sent_ = 0;
  unsent_ += line;
  unsent_ += '\n';
  return SendOn();
}

bool ChildProcess::SendOn() {
  while (HasUnsent()) {
    const ssize_t count = ::write(input_, unsent_.data() + sent_, unsent_.size() - sent_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return true;
    if (count < 0) {  // the rest cannot be sent
      if (errno != EPIPE) broken_by_ = errno;
      break;
    }
    sent_ += static_cast<std::size_t>(count);
  }
  const bool all_sent = !HasUnsent();
  unsent_.clear();
  sent_ = 0;
  return all_sent;
}

std::size_t ChildProcess::UnreadBytes() const {
  int in_pipe = 0;
  if (::ioctl(input_, FIONREAD, &in_pipe) != 0) in_pipe = 0;
  return static_cast<std::size_t>(in_pipe) + unsent_.size() - sent_;
}

bool ChildProcess::Receive(std::size_t max_line_bytes) {
  SendOn();  // even if the child has closed its input, its output may hold lines
  buffer_.erase(0, line_start_);
  scanned_ -= line_start_;
  line_start_ = 0;
  std::array<char, 1 << 16> chunk;
  for (int chunks = 0; chunks < kChunksPerReceive;) {
    const ssize_t count = ::read(output_, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (count < 0) broken_by_ = errno;
    if (count <= 0) return false;
    buffer_.append(chunk.data(), static_cast<std::size_t>(count));
    ++chunks;
  }
  if (broken_by_ != 0) return false;
  return buffer_.size() <= max_line_bytes || buffer_.find('\n', scanned_) != std::string::npos;
}

std::optional<std::string> ChildProcess::NextLine() {
  const std::size_t end = buffer_.find('\n', scanned_);
  if (end == std::string::npos) {
    scanned_ = buffer_.size();
    return std::nullopt;
  }
  std::string line = buffer_.substr(line_start_, end - line_start_);
  line_start_ = scanned_ = end + 1;
  return line;
}

ProcessUsage ChildProcess::MeasureAlone() const { return pid_ < 0 ? ProcessUsage{} : MeasureProcess(pid_); }

pid_t ChildProcess::FirstStarted() const {
  const std::vector<pid_t> started = pid_ < 0 ? std::vector<pid_t>() : ChildrenOf(pid_);
  return started.empty() ? -1 : started.front();
}

bool ChildProcess::HasEnded() const {
  siginfo_t info{};
  if (pid_ < 0 || ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0) return true;
  return info.si_pid == pid_;
}

std::string ChildProcess::Finish(int patience_ms) {
  if (pid_ < 0) return "not running";
  HeldTree tree(pid_);  // list the tree before the child ends: later, the child's descendants cannot be found
  ::close(input_);
  for (int i = 0; i < patience_ms && !HasEnded(); ++i) ::usleep(1000);
  ::close(output_);
  tree.Kill();
  ::kill(-pid_, SIGKILL);  // kill the group before the child is reaped: later, another group may have its ID
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  ManagedChildren().erase(pid_);
  EndOrphans();
  pid_ = input_ = output_ = -1;
  exit_code_ = ExitCode(status);
  return DescribeEnd(exit_code_);
}

}  // namespace etude
