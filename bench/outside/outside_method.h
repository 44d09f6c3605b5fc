#pragma once

#include <memory>
#include <string>
#include <vector>

#include "bench/model/payload.h"
#include "bench/model/row.h"
#include "io/files/json.h"
#include "io/process/fence.h"
#include "sim/random/seed.h"

namespace etude {

/// The version of the protocol for outside methods (docs/outside-methods.md).
constexpr int kProtocolVersion = 1;

struct OutsideOptions {
  std::vector<std::string> command;  ///< program and arguments
  std::string task;                  ///< the kind of task, sent in the handshake
  std::string options_json = {};     ///< an object sent in the handshake; "" = {}
  double time_s = 300;               ///< per problem, or per step of a session
  double memory_mb = 4096;           ///< resident, with all processes that the program has started
  std::string error_file = {};       ///< keeps its standard error, up to 1 MiB; "" = it shares ours
  /// The time limit of handshake and setting each, if time_s is less: programs load libraries and models then.
  double start_s = 30;
  Fence fence = {};                     ///< the sandbox that it runs in
  std::vector<std::string> files = {};  ///< files that the sandbox shows it (ProgramView)
  /// Keys the ids that replace the names of settings and problems. With a secret seed the program is restarted for
  /// every setting, so that its memory cannot carry anything from one condition to the next.
  Seed seed = 1;
};

/// Returns the longest time that Ask may take with the start_s above, seconds: handshake, setting, problem, and
/// cleaning up.
double MaxAskSeconds(double time_s);

/// The outcome of one problem.
struct OutsideReply {
  Status status = Status::kFailed;  ///< kOk: `answer` is valid; else there is no answer, for `reason`
  std::string reason;
  bool was_asked = true;  ///< false: this machine is the cause, as `reason` says; the program was not asked
  JsonPtr answer;         ///< an object with finite numbers
  double cpu_s = 0;       ///< of the program since its last reply; zero if it ended before it was measured
  double peak_mb = 0;     ///< the largest resident size while it worked on this, sampled 50 times a second
  int repeated = 0;       ///< lines ignored before this reply, because they answered questions that had an answer
};

/// A program that answers problems over its standard input and output. It is started at its first problem, kept for the
/// next ones, and restarted after it has failed. Repeated answers to an answered question are ignored at any time.
/// After three failures in a row of its start or of a setting there is no further attempt: the reply is the same as the
/// third time.
class OutsideMethod {
 public:
  explicit OutsideMethod(OutsideOptions options);
  OutsideMethod(OutsideMethod&&) noexcept;
  ~OutsideMethod();

  /// Sends one problem. `setting_id` names its setting; the program is sent `setting` first if another one is in force.
  /// Attachments are in a folder while it works.
  OutsideReply Ask(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                   const Payload& problem);

  /// Begins a session, and ends one in progress. It is sent like a problem, but the program replies `ready`, and then
  /// answers step by step. kOk: the session is in progress.
  OutsideReply Begin(const std::string& setting_id, const Payload& setting, const std::string& session_id,
                     const Payload& session);
  /// Sends the next step of the session, which must be in progress. Any reply but kOk ends it; the program is then
  /// restarted for the next one, unless it merely gave no answer (kUnsolved).
  OutsideReply Step(const Payload& step);

  /// Returns the program's own name: "name version"; "" before its first handshake.
  std::string ProgramName() const;
  /// Closes its input, waits, and returns how it ended: "exit code 0", "signal 9 (Killed)" if it had to be killed, "not
  /// running". The next problem starts it again.
  std::string End(int patience_ms);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
