#include "cli/interrupt.h"

#include <csignal>

namespace etude {
namespace {

std::atomic<bool> stop_requested = false;

void RequestStop(int signal) {
  stop_requested = true;
  std::signal(signal, SIG_DFL);
}

}  // namespace

Interrupt::Interrupt() : piped_(std::signal(SIGPIPE, SIG_IGN)) {
  std::signal(SIGINT, RequestStop);
  std::signal(SIGTERM, RequestStop);
}

Interrupt::~Interrupt() {
  std::signal(SIGPIPE, piped_);  // whoever closes our output from now on has read enough
}

const std::atomic<bool>* Interrupt::requested() const { return &stop_requested; }

}  // namespace etude
