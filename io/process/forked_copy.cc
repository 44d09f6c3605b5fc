#include "io/process/forked_copy.h"

#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <utility>

#include "engine/base/machine.h"

namespace etude {

Result<ForkedCopy> ForkedCopy::Start(const std::function<int(int socket)>& work) {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    return FailOfMachine("Etude cannot create a pair of sockets: {}", std::strerror(errno));
  }
  const pid_t parent = ::getpid(), child = ::fork();
  if (child == 0) {
    ::close(ends[0]);
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);  // the parent died before PR_SET_PDEATHSIG was set
    ::_exit(work(ends[1]));
  }
  const int why = errno;
  ::close(ends[1]);
  if (child < 0) {
    ::close(ends[0]);
    return FailOfMachine("Etude cannot start a process: {}", std::strerror(why));
  }
  return ForkedCopy(child, ends[0]);
}

ForkedCopy::ForkedCopy(ForkedCopy&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)), socket_(std::exchange(other.socket_, -1)), status_(other.status_) {}

ForkedCopy& ForkedCopy::operator=(ForkedCopy&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(socket_, other.socket_);
  std::swap(status_, other.status_);
  return *this;
}

ForkedCopy::~ForkedCopy() {
  Kill();
  Wait();
}

void ForkedCopy::Kill() {
  if (pid_ >= 0) ::kill(pid_, SIGKILL);
}

int ForkedCopy::Wait() {
  CloseSocket();
  if (pid_ < 0) return status_;
  while (::waitpid(pid_, &status_, 0) < 0 && errno == EINTR) {
  }
  pid_ = -1;
  return status_;
}

std::optional<int> ForkedCopy::StatusIfEnded() {
  if (pid_ < 0) return status_;
  if (::waitpid(pid_, &status_, WNOHANG) != pid_) return std::nullopt;
  pid_ = -1;
  CloseSocket();
  return status_;
}

void ForkedCopy::CloseSocket() {
  if (socket_ < 0) return;
  ::shutdown(socket_, SHUT_RDWR);  // also ends the connection of copies that were forked later and keep this end open
  ::close(std::exchange(socket_, -1));
}

bool SendAll(int socket, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

bool ReceiveAll(int socket, char* bytes, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::recv(socket, bytes, size, 0);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

}  // namespace etude
