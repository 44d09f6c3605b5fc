#pragma once

#include <atomic>
#include <functional>

#include "engine/base/result.h"

namespace etude {

/// Lets Ctrl-C (and SIGTERM) end the program at once from now on, with a line that says so and exit code 130. It is for
/// work that leaves nothing anywhere until it is done; other work has an Interrupt.
void EndWhenInterrupted();

/// A guard for work that can be stopped: while it lives, Ctrl-C (and SIGTERM) asks to stop, the second one ends the
/// program at once, and a child that died does not end the program.
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

/// Does `work` in a copy of this process, which Ctrl-C (and SIGTERM) ends wherever it is; `clean_up` then takes away
/// what it had begun. Gives the exit code that `work` gives. It is for work whose single steps take long.
int DoInterruptibly(const std::function<int()>& work, const std::function<void()>& clean_up);

/// Gives the outcome of writing a film, but false when Ctrl-C came: it reaches the encoder, too, whose end may be
/// noticed first.
Result<bool> UnlessInterrupted(Result<bool> is_whole, const Interrupt& interrupt);

}  // namespace etude
