#pragma once

#include <atomic>
#include <functional>

#include "engine/base/result.h"

namespace etude {

/// Makes Ctrl-C (and SIGTERM) end the program at once, with a message and exit code 130. Use it for work that writes
/// nothing before the work is complete; for other work, use Interrupt.
void EndWhenInterrupted();

/// A guard for work that can be stopped. While the guard exists, the first Ctrl-C (or SIGTERM) requests a stop, and the
/// second Ctrl-C ends the program at once. Meanwhile, writing to a child that has ended returns an error instead of
/// ending the program.
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

/// Runs `work` in a copy of this process. Ctrl-C (or SIGTERM) kills the copy at any point; then `clean_up` removes
/// unfinished output. Returns the exit code of `work`. Use it for work that cannot check often whether a stop was
/// requested.
int DoInterruptibly(const std::function<int()>& work, const std::function<void()>& clean_up);

/// Returns `is_whole`, the result of writing a film. If it is an error and Ctrl-C was pressed, returns false instead,
/// because Ctrl-C also ends the encoder, which then causes an error.
Result<bool> UnlessInterrupted(Result<bool> is_whole, const Interrupt& interrupt);

}  // namespace etude
