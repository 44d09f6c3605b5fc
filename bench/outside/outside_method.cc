#include "bench/outside/outside_method.h"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "bench/model/reasons.h"
#include "bench/outside/attachment_folder.h"
#include "bench/outside/messages.h"
#include "bench/outside/watched_program.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

template <typename T>
using Outcome = OutsideOutcome<T>;

constexpr int kMaxFailures = 3;
constexpr int kEndingMs = 500;       // the time in which a program must end after its input is closed
constexpr double kMaxLimit_s = 1e9;  // longer than any run; within the clock's range

/// Returns the error for a reply that came before the program had read the question.
Error TooEarly() { return {{}, "answered before it was asked"}; }

constexpr const char* kHint = " (inside a fence, it can read only the system's files and what its key 'files' lists)";

tl::unexpected<OutsideFailure> Failed(Status status, std::string reason) {
  return tl::unexpected<OutsideFailure>({status, std::move(reason)});
}

/// These functions make a failure from an error. BadOutput: the program's output is wrong. OurFailure: Etude's message
/// cannot be sent. NotAsked: this machine is the cause.
tl::unexpected<OutsideFailure> BadOutput(const Error& error) { return Failed(Status::kBadOutput, error.message); }
tl::unexpected<OutsideFailure> OurFailure(const Error& error) { return Failed(Status::kFailed, ToString(error)); }
tl::unexpected<OutsideFailure> NotAsked(const Error& error) {
  return tl::unexpected<OutsideFailure>({Status::kFailed, ToString(error), false});
}

}  // namespace

struct OutsideMethod::State {
  explicit State(OutsideOptions told) : options(std::move(told)), program(options) {}

  Outcome<void> EnsureStarted();
  Outcome<void> MakeReady(const std::string& setting_id, const Payload& setting);
  Outcome<Json> Solve(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                      const Payload& problem);
  Outcome<void> Begin(const std::string& setting_id, const Payload& setting, const std::string& id,
                      const Payload& begin);
  Outcome<Json> Step(const Payload& step);
  Outcome<void> CloseSession();
  OutsideReply ReplyOf(Outcome<Json> said);
  OutsideReply ReplyToStep(const Outcome<void>& done);
  Outcome<void> Start();
  Outcome<void> TellSetting(const std::string& id, const Payload& setting);
  template <typename Act>
  Outcome<void> Attempt(const std::string& what, Act act);

  enum class Measuring { kAtRest, kIfDue };
  template <typename Read>
  auto Exchange(const std::string& line, double seconds, Read read, Measuring measuring = Measuring::kAtRest)
      -> Outcome<typename decltype(read(line))::value_type>;
  template <typename Read>
  Outcome<void> ReadPendingLines(Read read);
  template <typename Read>
  Outcome<void> ReadRest(Read read);
  bool RepeatsAnswer(const std::string& line) const;
  void EndSession();
  std::string Stop(int patience_ms);

  /// Returns the id that replaces a name in the messages. It reveals nothing about the name.
  std::string IdOf(char kind, const std::string& name) const {
    return fmt::format("{}{:016x}", kind, RandomStream({options.seed, "exchange", 0}, kind + name).Bits());
  }
  double StartSeconds() const { return std::max(options.start_s, options.time_s); }

  const OutsideOptions options;
  WatchedProgram program;
  std::string program_name;
  std::optional<std::string> setting_in_force;
  AttachmentFolder setting_files;
  struct Session {
    std::string id;
    AttachmentFolder files;
    int steps = 0;  ///< number of steps sent in the session in progress
  };
  std::optional<Session> session;  ///< the session in progress
  std::set<std::string> answered;  ///< ids of the questions that the running program was asked before
  int repeated = 0;                ///< number of lines ignored since the last reply

  struct Failures {
    int times = 0;  ///< number of successive failures of one step
    OutsideFailure last;
  };
  std::map<std::string, Failures> failures;  ///< failures by the name of the step
};

/// Runs `act`, a step that many problems share (the start, a setting). After kMaxFailures failures in a row, returns
/// the last failure without another try.
template <typename Act>
Outcome<void> OutsideMethod::State::Attempt(const std::string& what, Act act) {
  Failures& failed = failures[what];
  if (failed.times == kMaxFailures) return tl::unexpected(failed.last);
  Outcome<void> done = act();
  if (done) {
    failed.times = 0;
    return done;
  }
  ++failed.times;
  failed.last = {done.error().status, fmt::format("{}: {}", what, done.error().reason), done.error().was_asked};
  return tl::unexpected(failed.last);
}

Outcome<void> OutsideMethod::State::EnsureStarted() {
  return program.IsRunning() ? Outcome<void>() : Attempt("in its start", [&] { return Start(); });
}

/// Makes the program ready for a problem: starts it and sends the setting, if this has not been done.
Outcome<void> OutsideMethod::State::MakeReady(const std::string& setting_id, const Payload& setting) {
  EndSession();
  if (!options.seed.IsPlain() && setting_in_force && setting_in_force != setting_id) Stop(kEndingMs);
  RETURN_IF_ERROR(EnsureStarted());
  if (setting_in_force != setting_id) {
    RETURN_IF_ERROR(Attempt("at setting " + Printable(setting_id), [&] { return TellSetting(setting_id, setting); }));
  }
  return {};
}

Outcome<void> OutsideMethod::State::Begin(const std::string& setting_id, const Payload& setting,
                                          const std::string& name, const Payload& begin) {
  RETURN_IF_ERROR(MakeReady(setting_id, setting));
  const std::string id = IdOf('p', name);
  auto files = AttachmentFolder::Write(program.attachment_root(), begin.files);
  if (!files) return NotAsked(files.error());
  const auto line = BeginLine(id, *begin.json, files->path());
  if (!line) return OurFailure(line.error());
  RETURN_IF_ERROR(Exchange(*line, options.time_s, ReadReady));
  answered.erase(id);
  session = {.id = id, .files = std::move(*files)};
  return {};
}

Outcome<Json> OutsideMethod::State::Step(const Payload& step) {
  const int number = session->steps++;
  const auto files = AttachmentFolder::Write(program.attachment_root(), step.files);
  if (!files) return NotAsked(files.error());
  const auto line = StepLine(session->id, number, *step.json, files->path());
  if (!line) return OurFailure(line.error());
  const auto read = [&](const std::string& said) -> Result<Json> {
    auto answer = ReadStepAnswer(said, session->id, number);
    if (!answer) return Fail({}, "at step {}: {}", number, answer.error().message);
    return answer;
  };
  return Exchange(*line, options.time_s, read, Measuring::kIfDue);
}

Outcome<void> OutsideMethod::State::CloseSession() {
  const std::string id = session->id;
  EndSession();
  RETURN_IF_ERROR(program.Rest());
  return ReadRest([&](const std::string& said) { return ReadAnswer(said, id); });
}

Outcome<Json> OutsideMethod::State::Solve(const std::string& setting_id, const Payload& setting,
                                          const std::string& name, const Payload& problem) {
  RETURN_IF_ERROR(MakeReady(setting_id, setting));
  const std::string problem_id = IdOf('p', name);
  const auto files = AttachmentFolder::Write(program.attachment_root(), problem.files);
  if (!files) return NotAsked(files.error());
  const auto line = ProblemLine(problem_id, *problem.json, files->path());
  if (!line) return OurFailure(line.error());
  const auto read = [&](const std::string& said) { return ReadAnswer(said, problem_id); };
  RETURN_IF_ERROR(
      // Read the pending lines while `answered` still contains this id. A pending line with this id answers an earlier
      // copy of the problem.
      ReadPendingLines(read));
  answered.erase(problem_id);
  auto answer = Exchange(*line, options.time_s, read);
  answered.insert(problem_id);
  if (answer) RETURN_IF_ERROR(ReadRest(read));
  return answer;
}

Outcome<void> OutsideMethod::State::Start() {
  if (options.command.empty()) return Failed(Status::kFailed, "no program is named");
  const auto told = options.options_json.empty() ? Json::object() : ReadJson(options.options_json, "its options");
  if (!told) return OurFailure(told.error());
  const auto hello = HelloLine(options.task, *told);
  if (!hello) return OurFailure(hello.error());
  RETURN_IF_ERROR(program.Start());
  answered.clear();
  auto reply = Exchange(*hello, StartSeconds(), ReadHello);
  const bool ended = !reply && (reply.error().status == Status::kCrashed || reply.error().status == Status::kFailed);
  if (ended) {  // the program has ended; the sandbox may be the cause
    if (auto tried = options.fence.Try(); !tried) return NotAsked(tried.error());
    const std::string cure = program.AdviceOnStartFailure();
    reply.error().reason += cure.empty() ? kHint : cure;
  }
  // If a program never replied to any handshake, the set-up of this machine counts as the cause: the program has not
  // been asked, and its cells get no rows.
  const bool is_silent = ended || (!reply && reply.error().status == Status::kTimeout);
  if (is_silent && program_name.empty()) reply.error().was_asked = false;
  if (!reply) return tl::unexpected(std::move(reply).error());
  program_name = reply->name + " " + reply->version;
  return {};
}

Outcome<void> OutsideMethod::State::TellSetting(const std::string& id, const Payload& setting) {
  auto files = AttachmentFolder::Write(program.attachment_root(), setting.files);
  if (!files) return NotAsked(files.error());
  setting_files = std::move(*files);
  const auto line = SettingLine(IdOf('s', id), *setting.json, setting_files.path());
  if (!line) return OurFailure(line.error());
  RETURN_IF_ERROR(Exchange(*line, StartSeconds(), ReadReady));
  RETURN_IF_ERROR(ReadRest(ReadReady));
  setting_in_force = id;
  return {};
}

/// Reads the lines that came since the last reply. Repeated answers are ignored. Any other line is an error, because no
/// question is open.
template <typename Read>
Outcome<void> OutsideMethod::State::ReadPendingLines(Read read) {
  program.Receive();
  while (const auto said = program.NextLine()) {
    if (!RepeatsAnswer(*said)) {
      const auto reply = read(program.WithoutFolder(*said));
      return BadOutput(reply ? TooEarly() : reply.error());
    }
    ++repeated;
  }
  return {};
}

/// Reads what the program wrote after a valid reply. This fails the question just answered, not the next one: which
/// question is the next depends on the number of workers.
template <typename Read>
Outcome<void> OutsideMethod::State::ReadRest(Read read) {
  Outcome<void> rest = ReadPendingLines(read);
  if (rest) rest = program.ReadRest();
  if (!rest) rest.error().reason = "after its reply: " + rest.error().reason;
  return rest;
}

/// Sends a line and returns the reply as parsed by `read`.
template <typename Read>
auto OutsideMethod::State::Exchange(const std::string& line, double seconds, Read read, Measuring measuring)
    -> Outcome<typename decltype(read(line))::value_type> {
  // Handle the pending lines, then send this line.
  const auto limit = std::chrono::duration<double>(std::min(seconds, kMaxLimit_s));
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  RETURN_IF_ERROR(ReadPendingLines(read));
  program.Send(line);
  const auto too_long = [&, before = repeated] {
    OutsideFailure failure = TookTooLong(seconds);
    if (repeated > before) failure.reason += "; it answered an earlier question again instead of this one";
    return tl::unexpected(std::move(failure));
  };
  while (true) {
    const auto said = program.WaitForLine(deadline, seconds);
    if (!said && said.error().status == Status::kTimeout) return too_long();
    if (!said) return tl::unexpected(said.error());
    auto reply = read(*said);
    // Ignore repeated answers until the deadline.
    if (!reply && RepeatsAnswer(*said)) {
      ++repeated;
      if (Clock::now() >= deadline) return too_long();
      continue;
    }
    if (!reply) {
      const auto again = read(program.WithoutFolder(*said));
      return BadOutput((again ? reply : again).error());
    }
    // A valid reply must come after the program has read the question. If more than this question is unread, the reply
    // came too early.
    if (program.UnreadBytes() > line.size()) return BadOutput(TooEarly());
    RETURN_IF_ERROR(measuring == Measuring::kAtRest ? program.Rest() : program.MeasureIfDue());
    if constexpr (std::is_void_v<typename decltype(reply)::value_type>) {
      return {};
    } else {
      return std::move(*reply);
    }
  }
}

/// Returns true if a line repeats an answer. Repeated answers are ignored, so that the result does not depend on
/// whether the line arrives before or after the next question.
bool OutsideMethod::State::RepeatsAnswer(const std::string& line) const {
  const Answered about = QuestionAnsweredBy(line);
  if (session && about.id == session->id) return about.step && *about.step < session->steps - 1;
  return answered.contains(about.id);
}

/// Ends the session. Later answers to the session count as repeated.
void OutsideMethod::State::EndSession() {
  if (session) answered.insert(session->id);
  session.reset();
}

std::string OutsideMethod::State::Stop(int patience_ms) {
  session.reset();
  setting_files = {};  // deleted first, because this process may be killed while it waits for the program
  setting_in_force.reset();
  return program.Stop(patience_ms);
}

double MaxAskSeconds(double time_s) {
  return 2 * std::max(OutsideOptions{}.start_s, time_s) + time_s + 2 * 1e-3 * WatchedProgram::kMaxDyingMs;
}

OutsideMethod::OutsideMethod(OutsideOptions options) : state_(std::make_unique<State>(std::move(options))) {}
OutsideMethod::OutsideMethod(OutsideMethod&&) noexcept = default;

OutsideMethod::~OutsideMethod() {
  if (state_ != nullptr) state_->Stop(kEndingMs);
}

OutsideReply OutsideMethod::Ask(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                                const Payload& problem) {
  state_->program.ForgetPeak();
  OutsideReply reply = state_->ReplyOf(state_->Solve(setting_id, setting, problem_id, problem));
  state_->program.SaveErrors();
  return reply;
}

OutsideReply OutsideMethod::Begin(const std::string& setting_id, const Payload& setting, const std::string& session_id,
                                  const Payload& session) {
  state_->program.ForgetPeak();
  return state_->ReplyToStep(state_->Begin(setting_id, setting, session_id, session));
}

OutsideReply OutsideMethod::Greet() { return state_->ReplyToStep(state_->EnsureStarted()); }

OutsideReply OutsideMethod::Step(const Payload& step) {
  assert(state_->session.has_value());
  OutsideReply reply = state_->ReplyOf(state_->Step(step));
  if (reply.status == Status::kOk) return reply;
  state_->EndSession();
  state_->program.SaveErrors();
  return reply;
}

OutsideReply OutsideMethod::EndSession() {
  assert(state_->session.has_value());
  return state_->ReplyToStep(state_->CloseSession());
}

/// Makes the reply and adds the resources that the program used. Stops the program after a failure.
OutsideReply OutsideMethod::State::ReplyOf(Outcome<Json> said) {
  if (!said) Stop(0);
  OutsideReply reply;
  reply.cpu_s = program.TakeCpuSeconds();
  reply.peak_mb = program.peak_mb();
  reply.repeated = std::exchange(repeated, 0);
  if (!said) {
    reply.status = said.error().status;
    reply.reason = said.error().reason;
    reply.was_asked = said.error().was_asked;
  } else if ((*said)["type"] == "no_answer") {
    reply.status = Status::kUnsolved;
    const std::string why = (*said)["reason"].get<std::string>();
    reply.reason = std::string(kGaveNoAnswer) + Printable(program.WithoutFolder(why), 200);
  } else {
    reply.status = Status::kOk;
    reply.answer = std::make_unique<Json>(std::move((*said)["answer"]));
  }
  return reply;
}

/// Makes the reply to an exchange without an answer: the handshake, or the beginning of a session.
OutsideReply OutsideMethod::State::ReplyToStep(const Outcome<void>& done) {
  OutsideReply reply = ReplyOf(done ? Outcome<Json>(Json{{"type", "answer"}, {"answer", Json::object()}})
                                    : tl::unexpected(done.error()));
  program.SaveErrors();
  return reply;
}

std::string OutsideMethod::ProgramName() const { return state_->program_name; }

std::string OutsideMethod::End(int patience_ms) { return state_->Stop(patience_ms); }

}  // namespace etude
