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

/// The version of the protocol spoken with methods outside (docs/outside-methods.md).
constexpr int kProtocolVersion = 1;

struct OutsideOptions {
  std::vector<std::string> command;  ///< program and arguments
  std::string task;                  ///< the kind of task, told in the handshake
  std::string options_json = {};     ///< an object told in the handshake; "" = {}
  double time_s = 300;               ///< per problem, or per step of a session
  double memory_mb = 4096;           ///< resident, with all that the program has started
  std::string error_file = {};       ///< its standard error is kept here, up to 1 MiB; "" = it shares ours
  /// Handshake and setting may take this long each, where time_s is less: programs load libraries and models then.
  double start_s = 30;
  Fence fence = {};                     ///< that it runs in
  std::vector<std::string> files = {};  ///< what the fence shows it (ProgramView)
  /// Keys the ids that stand for the names of settings and problems. Of a secret one, the program is started anew for
  /// every setting, so that it carries nothing in its memory from one condition to the next.
  Seed seed = 1;
};

/// Returns the seconds that Ask may take at most, with the start_s above: handshake, setting, problem, and the clearing
/// away.
double LongestAskSeconds(double time_s);

/// The outcome of one problem.
struct OutsideReply {
  Status status = Status::kFailed;  ///< kOk: `answer` is what it said; else it gave none, and why
  std::string reason;
  bool was_asked = true;  ///< false: something of this machine, which `reason` tells, is to blame: no answer of its own
  JsonPtr answer;         ///< an object, whose numbers are finite
  double cpu_s = 0;       ///< of the program since its last reply; zero when it ended before it was looked at
  double peak_mb = 0;     ///< the largest resident size seen while it worked on this; looked at 50 times a second
  int repeated = 0;       ///< lines that were passed over before this reply, because they answered what had an answer
};

/// A program that answers problems over its standard input and output. Started at its first problem, kept for
/// the next ones, and started anew after it has failed. What it says again of a question that it has answered is passed
/// over, whenever it comes. What goes wrong in its start or in a setting three times
/// in a row is not tried again: the reply is the same as that of the third time.
class OutsideMethod {
 public:
  explicit OutsideMethod(OutsideOptions options);
  OutsideMethod(OutsideMethod&&) noexcept;
  ~OutsideMethod();

  /// Puts one problem. `setting_id` names the setting that the problem belongs to; the program is told
  /// `setting` first when another one is in force. Attachments lie in a folder while it works.
  OutsideReply Ask(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                   const Payload& problem);

  /// Begins a session, which replaces one that still goes on: like a problem, but answered with `ready`, and step by
  /// step from then on. kOk: it goes on.
  OutsideReply Begin(const std::string& setting_id, const Payload& setting, const std::string& session_id,
                     const Payload& session);
  /// Puts the next step of the session. Any reply but kOk ends it, and the program is started anew for the next one,
  /// unless it merely gave no answer (kUnsolved). Only while a session goes on.
  OutsideReply Step(const Payload& step);

  /// Tells what the program calls itself: "name version"; "" before its first handshake.
  std::string ProgramName() const;
  /// Ends its input, waits, and says how it ended: "exit code 0", "signal 9 (Killed)" when it had to be killed, "not
  /// running". The next problem starts it anew.
  std::string End(int patience_ms);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace etude
