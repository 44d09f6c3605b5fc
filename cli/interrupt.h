#pragma once

#include <atomic>

namespace etude {

/// While it lives, Ctrl-C (and SIGTERM) asks to stop instead of ending the program, the second one ends it at once,
/// and a child that died is no reason to die ourselves.
class Interrupt {
 public:
  Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;
  ~Interrupt();

  const std::atomic<bool>* requested() const;

 private:
  void (*piped_)(int);
};

}  // namespace etude
