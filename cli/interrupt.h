#pragma once

#include <atomic>

#include "engine/base/result.h"

namespace etude {

/// From now on Ctrl-C (and SIGTERM) ends the program at once, with a line that says so and exit code 130. For work that
/// leaves nothing anywhere until it is done; other work has an Interrupt.
void EndWhenInterrupted();

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

/// What came of writing a film: false when Ctrl-C came, whichever was noticed first, that or the end of the encoder,
/// which it reaches, too.
Result<bool> UnlessInterrupted(Result<bool> is_whole, const Interrupt& interrupt);

}  // namespace etude
