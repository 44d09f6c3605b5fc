#include "bench/run/machine_trial.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "engine/base/machine.h"
#include "io/files/files.h"
#include "io/files/temporary_folder.h"
#include "io/process/child_process.h"
#include "io/process/forked_copy.h"
#include "sim/render/renderer.h"

namespace etude {
namespace {

/// Makes a renderer in a forked copy of this process. If memory is short, Mesa ends the process in which it runs, so
/// only the copy ends.
Result<void> TryRendererInACopy() {
  constexpr int kNotLoaded = 2;
  ASSIGN_OR_RETURN(ForkedCopy copy, ForkedCopy::Start([](int) {
                     const int silence = ::open("/dev/null", O_WRONLY);
                     ::dup2(silence, STDERR_FILENO);
                     return !LoadRenderer() ? kNotLoaded : SharedRenderer() ? 0 : 1;
                   }));
  const int status = copy.Wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (WIFEXITED(status) && WEXITSTATUS(status) == kNotLoaded) RETURN_IF_ERROR(LoadRenderer());
  return Fail({}, "cannot render: Mesa has too little memory, or provides no OpenGL context");
}

/// Fails if the sandbox (fence) could not be made because the machine has no more processes, memory or open files. Any
/// other reason why there is no sandbox is accepted.
Result<void> CheckFence(const Fence& fence) {
  for (const int shortage : {EAGAIN, ENOMEM, EMFILE, ENFILE}) {
    if (!fence.IsUp() && fence.description().find(std::strerror(shortage)) != std::string::npos) {
      return Fail({}, "cannot run a program in the fence: {}", fence.description());
    }
  }
  return {};
}

Result<void> Try(std::span<const PreparedScenario> scenarios, const Fence& fence) {
  RETURN_IF_ERROR(ChildProcess::Start({.program = "/bin/sh", .arguments = {"-c", ":"}}));
  if (std::ranges::any_of(scenarios, Draws, &PreparedScenario::scenario)) RETURN_IF_ERROR(TryRendererInACopy());
  bool is_first = true;
  for (const PreparedScenario& scenario : scenarios) {
    for (const auto& [program, role] : ProgramsIn(scenario.scenario())) {
      if (auto found = FindProgram(program->exec.front()); !found) {
        return Fail({}, "{} {} of scenario {} cannot be run: {}", role, program->name, scenario.scenario().name,
                    ToString(found.error()));
      }
      if (!std::exchange(is_first, false)) continue;
      RETURN_IF_ERROR(CheckFence(fence));
      ASSIGN_OR_RETURN(const auto folder, TemporaryFolder::Make("trial"));
      if (auto kept = WriteFileAtomically(folder.path() / "file", "a file of some bytes\n"); !kept) {
        // Keeps only the reason, because the path in the error is temporary.
        const std::string& said = kept.error().message;
        return Fail({folder.path().parent_path().string()}, "cannot create temporary files in this folder: {}",
                    said.substr(said.rfind(": ") + 2));
      }
    }
  }
  return {};
}

}  // namespace

Result<void> TryMachine(std::span<const PreparedScenario> scenarios, const Fence& fence) {
  auto tried = Try(scenarios, fence);
  if (tried || IsOfThisMachine(tried.error())) return tried;
  return tl::unexpected(OfThisMachine(tried.error()));
}

Result<void> TryRenderer(const PreparedScenario& scenario) {
  if (Draws(scenario.scenario())) RETURN_IF_ERROR(SharedRenderer());
  return {};
}

}  // namespace etude
