#pragma once

#include <sys/types.h>

#include <cstdio>
#include <string>
#include <vector>

namespace etude {

/// No input or output: the program gets /dev/null.
inline constexpr int kNowhere = -1;

/// Starts a trusted program, without a shell, with two descriptors as standard input and output and `log` as standard
/// error. Sets `child` and returns 0, or the errno of the failure. Outside programs are started as a ChildProcess.
int SpawnProgram(const std::vector<std::string>& words, int input, int output, std::FILE* log, pid_t& child);

/// Waits until a child has ended and returns its status (waitpid); 0 for child −1.
int WaitFor(pid_t child);

/// Returns the first line of a log, which usually names the cause; cut after 400 bytes.
std::string FirstLineOf(std::FILE* log);

}  // namespace etude
