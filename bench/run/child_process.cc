#include "bench/run/child_process.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

namespace etude {
namespace {

/// Our environment with the pinned settings in place of its own.
std::vector<std::string> PinnedCopyOfEnvironment() {
  std::vector<std::string> result = PinnedEnvironment();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view setting = *entry;
    const std::string_view name = setting.substr(0, setting.find('='));
    const bool pinned = std::any_of(PinnedEnvironment().begin(), PinnedEnvironment().end(), [&](const auto& other) {
      return std::string_view(other).substr(0, other.find('=')) == name;
    });
    if (!pinned) result.emplace_back(setting);
  }
  return result;
}

std::vector<char*> Pointers(std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (std::string& text : texts) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

const std::vector<std::string>& PinnedEnvironment() {
  static const std::vector<std::string> settings = {
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  // its sin, exp, … have FMA variants with other last bits
      "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",                  // llvmpipe compiles shaders for the CPU it meets
      "MESA_SHADER_CACHE_DISABLE=true",                    // the cache forgets for which CPU a shader was compiled
      "LP_NUM_THREADS=0",                                  // one process per core is faster than threads
  };
  return settings;
}

Result<ChildProcess> ChildProcess::Start(const std::string& program, const std::vector<std::string>& arguments) {
  std::array<int, 2> input{}, output{};
  if (pipe2(input.data(), O_CLOEXEC) != 0) return Fail({}, "no pipe can be made: {}", std::strerror(errno));
  if (pipe2(output.data(), O_CLOEXEC) != 0) {
    ::close(input[0]);
    ::close(input[1]);
    return Fail({}, "no pipe can be made: {}", std::strerror(errno));
  }
  // Everything that allocates happens before fork: between fork and exec only system calls are safe.
  std::vector<std::string> argument_texts = {program};
  argument_texts.insert(argument_texts.end(), arguments.begin(), arguments.end());
  std::vector<std::string> environment_texts = PinnedCopyOfEnvironment();
  const std::vector<char*> argv = Pointers(argument_texts);
  const std::vector<char*> envp = Pointers(environment_texts);
  const pid_t pid = ::fork();
  if (pid == 0) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::signal(SIGINT, SIG_IGN);  // what is sent to the whole group is the parent's to handle
    ::signal(SIGTERM, SIG_IGN);
    ::signal(SIGPIPE, SIG_DFL);
    ::dup2(input[0], STDIN_FILENO);
    ::dup2(output[1], STDOUT_FILENO);
    ::execve(program.c_str(), argv.data(), envp.data());
    ::_exit(127);
  }
  ::close(input[0]);
  ::close(output[1]);
  if (pid < 0) {
    ::close(input[1]);
    ::close(output[0]);
    return Fail({}, "no process can be started: {}", std::strerror(errno));
  }
  ::fcntl(output[0], F_SETFL, O_NONBLOCK);
  return ChildProcess(pid, input[1], output[0]);
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      input_(std::exchange(other.input_, -1)),
      output_(std::exchange(other.output_, -1)),
      buffer_(std::move(other.buffer_)),
      scanned_(std::exchange(other.scanned_, 0)) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  if (this != &other) {
    Finish();
    pid_ = std::exchange(other.pid_, -1);
    input_ = std::exchange(other.input_, -1);
    output_ = std::exchange(other.output_, -1);
    buffer_ = std::move(other.buffer_);
    scanned_ = std::exchange(other.scanned_, 0);
  }
  return *this;
}

ChildProcess::~ChildProcess() { Finish(); }

bool ChildProcess::Send(const std::string& line) {
  const std::string text = line + "\n";
  for (std::size_t sent = 0; sent < text.size();) {
    const ssize_t count = ::write(input_, text.data() + sent, text.size() - sent);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    sent += static_cast<std::size_t>(count);
  }
  return true;
}

bool ChildProcess::Receive() {
  std::array<char, 1 << 16> chunk;
  while (true) {
    const ssize_t count = ::read(output_, chunk.data(), chunk.size());
    if (count > 0) {
      buffer_.append(chunk.data(), static_cast<std::size_t>(count));
    } else if (count < 0 && errno == EINTR) {
      continue;
    } else {
      return count < 0 && (errno == EAGAIN || errno == EWOULDBLOCK);
    }
  }
}

std::optional<std::string> ChildProcess::NextLine() {
  const std::size_t end = buffer_.find('\n', scanned_);
  if (end == std::string::npos) {
    scanned_ = buffer_.size();
    return std::nullopt;
  }
  std::string line = buffer_.substr(0, end);
  buffer_.erase(0, end + 1);
  scanned_ = 0;
  return line;
}

std::string ChildProcess::Finish() {
  if (pid_ < 0) return "not running";
  ::close(input_);
  ::close(output_);
  int status = 0;
  // A child that closed its output, or whose input has just ended, is about to end by itself.
  bool ended = ::waitpid(pid_, &status, WNOHANG) == pid_;
  for (int i = 0; i < 50 && !ended; ++i) {
    ::usleep(1000);
    ended = ::waitpid(pid_, &status, WNOHANG) == pid_;
  }
  if (!ended) {
    ::kill(pid_, SIGKILL);
    ::waitpid(pid_, &status, 0);
  }
  pid_ = input_ = output_ = -1;
  if (WIFSIGNALED(status)) return fmt::format("signal {} ({})", WTERMSIG(status), strsignal(WTERMSIG(status)));
  return fmt::format("exit code {}", WEXITSTATUS(status));
}

}  // namespace etude
