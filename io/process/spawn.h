#pragma once

#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

namespace etude {

/// Stands for a program's input or output where it has none.
inline constexpr int kNowhere = -1;

/// Starts a program of this machine, without a shell, between two descriptors; its standard error goes to `log`. Returns
/// 0, or the errno that says why it could not be started. Programs that are not ours are a `ChildProcess`.
int SpawnProgram(const std::vector<std::string>& words, int input, int output, std::FILE* log, pid_t& child);

/// Waits for the end of a child and returns its status as waitpid gives it; −1 stands for a child that has been reaped.
int WaitFor(pid_t child);

/// Returns the first line of a log, which names the cause; the lines that follow are consequences.
std::string FirstLineOf(std::FILE* log);

}  // namespace etude
