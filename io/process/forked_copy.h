#pragma once

#include <sys/types.h>

#include <cstddef>
#include <functional>
#include <optional>
#include <string_view>

#include "engine/base/result.h"

namespace etude {

/// A forked copy of this process that does one piece of work and ends. This process and the copy each have one end of a
/// pair of sockets. The kernel kills the copy if this process dies; the destructor kills and reaps it. At the fork,
/// other threads of this process must not hold locks that `work` needs.
class ForkedCopy {
 public:
  /// Starts a copy that runs `work` with the copy's end of the sockets. The return value of `work` becomes the copy's
  /// exit code; no destructor or exit handler of this process runs in the copy. On failure, the error's cause is this
  /// machine.
  static Result<ForkedCopy> Start(const std::function<int(int socket)>& work);
  ForkedCopy(ForkedCopy&& other) noexcept;
  ForkedCopy& operator=(ForkedCopy&& other) noexcept;
  ~ForkedCopy();

  /// Returns the descriptor of our end of the sockets; −1 after `Wait`.
  int socket() const { return socket_; }

  /// Sends SIGKILL. Wait must still be called.
  void Kill();

  /// Closes our end of the sockets, waits until the copy has ended, and returns its status (waitpid).
  int Wait();

  /// Returns the copy's status if it has ended; does not wait.
  std::optional<int> StatusIfEnded();

 private:
  ForkedCopy(pid_t pid, int socket) : pid_(pid), socket_(socket) {}
  void CloseSocket();

  pid_t pid_ = -1;  ///< process ID of the copy; −1 after it has been reaped
  int socket_ = -1;
  int status_ = 0;
};

/// Writes all bytes to a socket. Returns false if the socket's other end is closed.
bool SendAll(int socket, std::string_view bytes);

/// Reads exactly `size` bytes from a socket. Returns false if the socket's other end is closed earlier.
bool ReceiveAll(int socket, char* bytes, std::size_t size);

}  // namespace etude
