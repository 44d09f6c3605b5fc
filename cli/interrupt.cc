#include "cli/interrupt.h"

#include <poll.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <string_view>

#include "cli/commands.h"

namespace etude {
namespace {

std::atomic<bool> stop_requested = false;

void RequestStop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

/// Ends the program at once. Only system calls are safe in a signal handler.
void End(int) {
  constexpr std::string_view kLine = "etude: stopped; nothing half done is kept\n";
  [[maybe_unused]] const ssize_t written = ::write(STDERR_FILENO, kLine.data(), kLine.size());
  ::_exit(kInterrupted);
}

void OnInterrupt(void (*handler)(int)) {
  std::signal(SIGINT, handler);
  std::signal(SIGTERM, handler);
}

}  // namespace

void EndWhenInterrupted() { OnInterrupt(End); }

Interrupt::Interrupt() : piped_(std::signal(SIGPIPE, SIG_IGN)) { OnInterrupt(RequestStop); }

Interrupt::~Interrupt() {
  OnInterrupt(End);
  std::signal(SIGPIPE, piped_);  // whoever closes our output from now on has read enough
}

const std::atomic<bool>* Interrupt::requested() const { return &stop_requested; }

int DoInterruptibly(const std::function<int()>& work, const std::function<void()>& clean_up) {
  const Interrupt interrupt;
  std::fflush(nullptr);  // lest the copy print it, too
  const pid_t parent = ::getpid(), child = ::fork();
  if (child < 0) {
    Complain({{}, std::string("no process can be started: ") + std::strerror(errno)});
    return kIncomplete;
  }
  if (child == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    const int code = ::getppid() == parent ? work() : kInterrupted;
    std::fflush(nullptr);
    ::_exit(code);
  }
  int status = 0;
  while (::waitpid(child, &status, WNOHANG) == 0) {
    if (*interrupt.requested()) ::kill(child, SIGKILL);
    ::poll(nullptr, 0, 20);
  }
  if (WIFEXITED(status)) return WEXITSTATUS(status);
  clean_up();
  if (*interrupt.requested()) return TellStopped();
  Complain({{}, "stopped by " + std::string(::strsignal(WTERMSIG(status))) + "; nothing is kept"});
  return kIncomplete;
}

Result<bool> UnlessInterrupted(Result<bool> is_whole, const Interrupt& interrupt) {
  if (!is_whole && *interrupt.requested()) return false;
  return is_whole;
}

}  // namespace etude
