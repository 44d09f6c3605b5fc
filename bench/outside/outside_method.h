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
  double time_s = 300;               ///< time limit per problem, or per step of a session
  double memory_mb = 4096;           ///< limit of resident memory of the program with all its processes
  std::string error_file = {};       ///< file for the program's standard error, up to 1 MiB; "" = the program shares
                                     ///< Etude's standard error
  /// The shortest time limit, in seconds, of the handshake and of each setting; `time_s` applies if it is longer.
  /// During these steps, programs load libraries and models.
  double start_s = 30;
  Fence fence = {};                     ///< the sandbox in which the program runs
  std::vector<std::string> files = {};  ///< files that the sandbox shows the program (ProgramView)
  /// True: the user names `files` by options of the command line; false: by a key of the scenario. Error messages then
  /// show how to name further files in the same way.
  bool by_options = false;
  /// The seed of the random ids that replace the names of settings and problems. With a secret seed the program is
  /// restarted for every setting, so that its memory carries nothing from one condition to the next.
  Seed seed = 1;
};

/// Returns the longest time that Ask may take with the default start_s, seconds. This time covers the handshake, the
/// setting, the problem and the cleaning up.
double MaxAskSeconds(double time_s);

/// The outcome of one problem, or of one step of a session.
struct OutsideReply {
  Status status = Status::kFailed;  ///< kOk: `answer` is valid; else `reason` says why there is none
  std::string reason;
  /// False if this machine or its set-up is the cause of the failure: for example, the program could not be started, or
  /// never replied to its first handshake. `reason` then says why.
  bool was_asked = true;
  JsonPtr answer;      ///< an object with finite numbers
  double cpu_s = 0;    ///< processor time since the last reply; 0 if the program ended before the first sample
  double peak_mb = 0;  ///< the program's largest memory during this problem, sampled 50 times a second
  /// Number of lines ignored before this reply, because they repeat answers to earlier questions.
  int repeated = 0;
};

/// A program that answers problems over its standard input and output. It is started for the first problem, kept for
/// the next ones, and restarted after a failure. Repeated answers are always ignored. If the start or a setting fails
/// three times in a row, this step is not tried again, and every further reply equals the third.
class OutsideMethod {
 public:
  explicit OutsideMethod(OutsideOptions options);
  OutsideMethod(OutsideMethod&&) noexcept;
  ~OutsideMethod();

  /// Starts the program and exchanges the handshake, unless the program runs already. If the status is kOk, ProgramName
  /// is known.
  OutsideReply Greet();

  /// Sends one problem and waits for the reply. `setting` is sent first, unless it was the last setting sent;
  /// `setting_id` identifies it. The problem's attachments exist in a folder until the reply.
  OutsideReply Ask(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                   const Payload& problem);

  /// Begins a session, after ending a session in progress. A session is sent like a problem, but the program replies
  /// `ready` and then answers each step. If the status is kOk, the session is in progress.
  OutsideReply Begin(const std::string& setting_id, const Payload& setting, const std::string& session_id,
                     const Payload& session);
  /// Sends the next step of the session in progress. Any status but kOk ends the session. The program is then restarted
  /// for the next session, except after kUnsolved (the program gave no answer).
  OutsideReply Step(const Payload& step);
  /// Ends the session in progress. Fails if the program wrote anything but repeated answers after its last reply.
  OutsideReply EndSession();

  /// Returns the name and version that the program stated in its handshake, "name version"; "" before the first
  /// handshake.
  std::string ProgramName() const;
  /// Closes the program's input, waits up to `patience_ms`, and returns how the program ended: "exit code 0", "signal 9
  /// (Killed)" if it had to be killed, or "not running". The next problem starts the program again.
  std::string End(int patience_ms);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
