#include "cli/interrupt.h"

#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstring>
#include <optional>
#include <string_view>

#include "cli/commands.h"
#include "io/process/forked_copy.h"

namespace etude {
namespace {

std::atomic<bool> stop_requested = false;

void RequestStop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

/// Ends the program at once. Only system calls are safe in a signal handler.
void End(int) {
  constexpr std::string_view kLine = "etude: stopped; no partial result was kept\n";
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
  std::signal(SIGPIPE, piped_);  // from now on, a closed output may end the program
}

const std::atomic<bool>* Interrupt::requested() const { return &stop_requested; }

int DoInterruptibly(const std::function<int()>& work, const std::function<void()>& clean_up) {
  const Interrupt interrupt;
  std::fflush(nullptr);  // otherwise the copy would print buffered text again
  auto copy = ForkedCopy::Start([&](int) {
    const int code = work();
    std::fflush(nullptr);
    return code;
  });
  if (!copy) return Complain(copy.error());
  std::optional<int> status;
  while (!(status = copy->StatusIfEnded())) {
    if (*interrupt.requested()) copy->Kill();
    ::poll(nullptr, 0, 20);
  }
  if (WIFEXITED(*status)) return WEXITSTATUS(*status);
  clean_up();
  if (*interrupt.requested()) return TellStopped();
  Complain({{}, "stopped by " + std::string(::strsignal(WTERMSIG(*status))) + "; no result was kept"});
  return kIncompleteRun;
}

Result<bool> UnlessInterrupted(Result<bool> is_whole, const Interrupt& interrupt) {
  if (!is_whole && *interrupt.requested()) return false;
  return is_whole;
}

}  // namespace etude
