#include "bench/process/held_tree.h"

#include <signal.h>
#include <sys/syscall.h>

#include <algorithm>

#include "bench/process/process_tree.h"

namespace etude {
namespace {

constexpr int kMostLooks = 100;  // at a tree that grows while it is held

bool Signal(const Descriptor& process, int signal) {
  return ::syscall(SYS_pidfd_send_signal, process.number(), signal, nullptr, 0) == 0;
}

}  // namespace

HeldTree::HeldTree(pid_t root) {
  AddTree(root);
  for (int i = 0; i < kMostLooks && Grow(); ++i) {
  }
}

void HeldTree::Kill() {
  // A stopped process starts no other, but may have just forked: stop and list until two passes find nothing new.
  for (int i = 0, quiet = 0; i < kMostLooks && quiet < 2; ++i) {
    SignalAll(SIGSTOP);
    quiet = Grow() ? 0 : quiet + 1;
  }
  SignalAll(SIGKILL);
}

bool HeldTree::Grow() {
  const std::size_t before = processes_.size();
  for (std::size_t i = 0; i < before; ++i) {
    constexpr int kOnlyAsk = 0;
    if (Signal(processes_[i].handle, kOnlyAsk)) AddTree(processes_[i].number);
  }
  return processes_.size() > before;
}

void HeldTree::AddTree(pid_t root) {
  for (const pid_t number : ProcessTree(root)) {
    const bool known = std::any_of(processes_.begin(), processes_.end(),
                                   [&](const Process& process) { return process.number == number; });
    if (!known) processes_.push_back({number, Descriptor(static_cast<int>(::syscall(SYS_pidfd_open, number, 0)))});
  }
}

void HeldTree::SignalAll(int signal) const {
  for (const Process& process : processes_) Signal(process.handle, signal);
}

}  // namespace etude
