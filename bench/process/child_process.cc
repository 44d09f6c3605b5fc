#include "bench/process/child_process.h"

#include <fcntl.h>
#include <linux/close_range.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <set>
#include <utility>

#include "bench/process/pinned_environment.h"
#include "bench/process/process_tree.h"

namespace etude {
namespace {

bool IsProgram(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && S_ISREG(status.st_mode) && ::access(path.c_str(), X_OK) == 0;
}

constexpr int kTold = STDERR_FILENO + 1;  // the descriptor of ChildOptions::told
constexpr int kChunksPerReceive = 16;     // a child that never stops talking must not keep us from looking at the clock

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

struct Pipe {
  Descriptor read, write;
};

Result<Pipe> MakePipe() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) return Fail({}, "no pipe can be made: {}", std::strerror(errno));
  return Pipe{Descriptor(ends[0]), Descriptor(ends[1])};
}

void Limit(__rlimit_resource resource, rlim_t most) {
  rlimit limit{};
  ::getrlimit(resource, &limit);
  limit.rlim_max = std::min(limit.rlim_max, most);
  limit.rlim_cur = std::min(limit.rlim_cur, limit.rlim_max);
  ::setrlimit(resource, &limit);
}

/// Sets the limits that keep a program that is not ours within bounds wherever it runs.
void LimitProgram() {
  ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  Limit(RLIMIT_FSIZE, ProgramLimits::kFileBytes);
  Limit(RLIMIT_NOFILE, ProgramLimits::kOpenFiles);
  Limit(RLIMIT_CORE, 0);
}

/// Turns a forked child into the program. Only system calls are safe here.
[[noreturn]] void BecomeProgram(const char* path, char* const* argv, char* const* envp, int input, int output,
                                int errors, int told, int report, pid_t parent, bool limited) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_CHILD_SUBREAPER, 1);  // orphans below it stay below it, where they can be found
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (::getppid() != parent) ::_exit(0);  // we died before the line above
  for (const int number : {SIGINT, SIGTERM, SIGPIPE, SIGCHLD, SIGXFSZ}) ::signal(number, SIG_DFL);
  if (limited) LimitProgram();
  ::dup2(input, STDIN_FILENO);
  ::dup2(output, STDOUT_FILENO);
  if (errors >= 0) ::dup2(errors, STDERR_FILENO);
  if (report == kTold) report = ::dup(report);
  if (told >= 0) ::dup2(told, kTold);
  ::close_range(told >= 0 ? kTold + 1 : kTold, ~0U, CLOSE_RANGE_CLOEXEC);
  if (told == kTold) ::fcntl(kTold, F_SETFD, 0);
  ::execve(path, argv, envp);
  const int reason = errno;
  if (::write(report, &reason, sizeof reason) < 0) ::_exit(126);
  ::_exit(127);
}

/// A file in memory that holds `text`, to be read from its beginning.
Result<Descriptor> HoldText(std::string_view text) {
  Descriptor held(::memfd_create("told", MFD_CLOEXEC));
  if (held.number() < 0 || ::write(held.number(), text.data(), text.size()) != static_cast<ssize_t>(text.size()) ||
      ::lseek(held.number(), 0, SEEK_SET) != 0) {
    return Fail({}, "what a program is told cannot be held: {}", std::strerror(errno));
  }
  return held;
}

/// The children of this process that are spoken to. Where it adopts orphans, all others are such.
std::set<pid_t>& ManagedChildren() {
  static std::set<pid_t> children;
  return children;
}

/// Ends what a child that has ended left behind, if this process adopts it.
void EndOrphans() {
  int adopts = 0;
  ::prctl(PR_GET_CHILD_SUBREAPER, &adopts);
  if (adopts == 0) return;
  constexpr int kMostLooks = 100;  // at orphans of orphans
  bool found = true;
  for (int i = 0; found && i < kMostLooks; ++i) {
    found = false;
    for (const pid_t child : ChildrenOf(::getpid())) {
      if (ManagedChildren().contains(child)) continue;
      found = true;
      HeldTree(child).Kill();
      ::waitpid(child, nullptr, 0);
    }
  }
}

/// Describes how a program ended. A shell, and a fence, tell a signal by an exit code beyond 128.
std::string DescribeEnd(int status) {
  const int code = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  const int signal = code - 128;
  if (signal <= 0 || signal >= NSIG) return fmt::format("exit code {}", code);
  return fmt::format("signal {} ({})", signal, strsignal(signal));
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

void AdoptOrphans() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }

Result<ChildProcess> ChildProcess::Start(const ChildOptions& options) {
  ASSIGN_OR_RETURN(const auto path, FindProgram(options.program));
  auto input = MakePipe(), output = MakePipe(), report = MakePipe();
  for (const auto* pipe : {&input, &output, &report}) {
    if (!*pipe) return tl::unexpected(pipe->error());
  }
  Descriptor errors;
  if (!options.error_file.empty()) {
    errors = Descriptor(::open(options.error_file.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
    if (errors.number() < 0) return Fail({options.error_file, 0, 0}, "cannot write: {}", std::strerror(errno));
  }
  Descriptor told;
  if (!options.told.empty()) {
    ASSIGN_OR_RETURN(told, HoldText(options.told));
  }
  // Everything that allocates happens before fork: between fork and exec only system calls are safe.
  std::vector<std::string> argument_texts = {options.program};
  argument_texts.insert(argument_texts.end(), options.arguments.begin(), options.arguments.end());
  std::vector<std::string> environment_texts = ClosedEnvironment();
  if (options.limited) std::erase_if(environment_texts, [](const auto& text) { return text.starts_with("PWD="); });
  const std::vector<char*> argv = Pointers(argument_texts);
  const std::vector<char*> envp = Pointers(environment_texts);
  ::signal(SIGPIPE, SIG_IGN);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid == 0) {
    BecomeProgram(path.c_str(), argv.data(), envp.data(), input->read.number(), output->write.number(), errors.number(),
                  told.number(), report->write.number(), parent, options.limited);
  }
  if (pid < 0) return Fail({}, "no process can be started: {}", std::strerror(errno));
  ManagedChildren().insert(pid);
  report->write.Close();
  int reason = 0;
  ssize_t count = 0;
  while ((count = ::read(report->read.number(), &reason, sizeof reason)) < 0 && errno == EINTR) {
  }
  if (count > 0) {
    ::waitpid(pid, nullptr, 0);
    ManagedChildren().erase(pid);
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
    if (count < 0) break;  // nobody will ever take the rest
    sent_ += static_cast<std::size_t>(count);
  }
  const bool all_sent = !HasUnsent();
  unsent_.clear();
  sent_ = 0;
  return all_sent;
}

bool ChildProcess::Receive(std::size_t longest_line) {
  SendOn();  // a child that no longer listens may still have something to say
  buffer_.erase(0, line_start_);
  scanned_ -= line_start_;
  line_start_ = 0;
  std::array<char, 1 << 16> chunk;
  for (int chunks = 0; chunks < kChunksPerReceive;) {
    const ssize_t count = ::read(output_, chunk.data(), chunk.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) break;
    if (count <= 0) return false;
    buffer_.append(chunk.data(), static_cast<std::size_t>(count));
    ++chunks;
  }
  return buffer_.size() <= longest_line || buffer_.find('\n', scanned_) != std::string::npos;
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

ProcessUsage ChildProcess::Measure() const { return pid_ < 0 ? ProcessUsage{} : MeasureTree(pid_); }

ProcessUsage ChildProcess::MeasureAlone() const { return pid_ < 0 ? ProcessUsage{} : MeasureProcess(pid_); }

bool ChildProcess::HasEnded() const {
  siginfo_t info{};
  if (pid_ < 0 || ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT) != 0) return true;
  return info.si_pid == pid_;
}

std::string ChildProcess::Finish(int patience_ms) {
  if (pid_ < 0) return "not running";
  HeldTree tree(pid_);  // descendants of a child that ended could not be found any more
  ::close(input_);
  for (int i = 0; i < patience_ms && !HasEnded(); ++i) ::usleep(1000);
  ::close(output_);
  tree.Kill();
  ::kill(-pid_, SIGKILL);  // before it is reaped: until then its number, and so its group's, is nobody else's
  int status = 0;
  while (::waitpid(pid_, &status, 0) < 0 && errno == EINTR) {
  }
  ManagedChildren().erase(pid_);
  EndOrphans();
  pid_ = input_ = output_ = -1;
  return DescribeEnd(status);
}

}  // namespace etude
