#include "io/process/spawn.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>

namespace etude {

int SpawnProgram(const std::vector<std::string>& words, int input, int output, std::FILE* log, pid_t& child) {
  std::vector<char*> argv;
  for (const std::string& word : words) argv.push_back(const_cast<char*>(word.c_str()));
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  const auto attach = [&](int given, int standard, int mode) {
    if (given < 0) return posix_spawn_file_actions_addopen(&actions, standard, "/dev/null", mode, 0);
    return posix_spawn_file_actions_adddup2(&actions, given, standard);
  };
  attach(input, STDIN_FILENO, O_RDONLY);
  attach(output, STDOUT_FILENO, O_WRONLY);
  attach(fileno(log), STDERR_FILENO, O_WRONLY);
  const int error = posix_spawnp(&child, argv.front(), &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

int WaitFor(pid_t child) {
  int status = 0;
  while (child >= 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  return status;
}

std::string FirstLineOf(std::FILE* log) {
  std::string words(400, '\0');
  std::rewind(log);
  words.resize(std::fread(words.data(), 1, words.size(), log));
  words.resize(std::min(words.find('\n'), words.size()));
  return words;
}

}  // namespace etude
