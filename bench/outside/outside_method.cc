#include "bench/outside/outside_method.h"

#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <chrono>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <type_traits>
#include <utility>

#include "bench/files/temporary_folder.h"
#include "bench/outside/attachment_folder.h"
#include "bench/outside/error_log.h"
#include "bench/outside/messages.h"
#include "bench/outside/program_view.h"
#include "bench/process/child_process.h"
#include "bench/process/clock.h"
#include "sim/random/stream.h"

namespace etude {
namespace {

constexpr std::chrono::milliseconds kLookEvery{20};  // at memory, and at whether it still runs
constexpr std::chrono::milliseconds kLookAtMappingsEvery{200};
constexpr int kMostFailures = 3;
constexpr int kDyingMs = 1000;     // from closing its output to its end
constexpr int kEndingMs = 500;     // from the end of its input to its own
constexpr double kLongestS = 1e9;  // beyond any run, within what the clock can hold

/// Of a reply to what has not been read: it was said before the question.
Error TooEarly() { return {{}, "answered before it was asked"}; }

/// Told whether there is a fence or not: the same program fails with the same words everywhere.
constexpr const char* kHint = " (a fence shows it the system and what its key 'files' lists)";

/// Why there is no answer.
struct Failure {
  Status status = Status::kFailed;
  std::string reason;
  bool was_asked = true;
};
template <typename T>
using Outcome = tl::expected<T, Failure>;

tl::unexpected<Failure> Failed(Status status, std::string reason) {
  return tl::unexpected<Failure>({status, std::move(reason)});
}

Failure TooLong(double seconds) { return {Status::kTimeout, fmt::format("took longer than {:g} s", seconds)}; }

/// Blames a program for what it said; OurFailure is for what cannot be said to it; NotAsked blames this machine.
tl::unexpected<Failure> BadOutput(const Error& error) { return Failed(Status::kBadOutput, error.message); }
tl::unexpected<Failure> OurFailure(const Error& error) { return Failed(Status::kFailed, ToString(error)); }
tl::unexpected<Failure> NotAsked(const Error& error) {
  return tl::unexpected<Failure>({Status::kFailed, ToString(error), false});
}

}  // namespace

struct OutsideMethod::State {
  explicit State(OutsideOptions told) : options(std::move(told)), errors(options.error_file) {}

  Outcome<void> MakeReady(const std::string& setting_id, const Payload& setting);
  Outcome<Json> Solve(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                      const Payload& problem);
  Outcome<void> Begin(const std::string& setting_id, const Payload& setting, const std::string& id,
                      const Payload& begin);
  Outcome<Json> Step(const Payload& step);
  OutsideReply ReplyOf(Outcome<Json> said);
  std::string WithoutFolder(std::string text) const;
  Outcome<void> Start();
  Outcome<void> TellSetting(const std::string& id, const Payload& setting);
  template <typename Act>
  Outcome<void> Attempt(const std::string& what, Act act);

  enum class Looks { kAlways, kNowAndThen };
  template <typename Read>
  auto Exchange(const std::string& line, double seconds, Read read, Looks looks = Looks::kAlways)
      -> Outcome<typename decltype(read(line))::value_type>;
  template <typename Read>
  Outcome<void> HearBefore(Read read);
  bool IsRepeated(const std::string& line) const;
  Outcome<std::string> WaitForLine(Clock::time_point deadline, double seconds);
  Outcome<void> Look();
  Failure HowItEnded();
  void EndSession();
  std::string Stop(int patience_ms);

  /// The id that stands for a name in the conversation, and tells nothing of it.
  std::string IdOf(char kind, const std::string& name) const {
    return fmt::format("{}{:016x}", kind, RandomStream({options.seed, "exchange", 0}, kind + name).Bits());
  }
  double StartSeconds() const { return std::max(options.start_s, options.time_s); }

  const OutsideOptions options;
  ErrorLog errors;
  std::optional<TemporaryFolder> attachment_root;  ///< where attachments lie, from the first start on
  std::optional<ChildProcess> child;
  std::string program_name;
  std::optional<std::string> setting_in_force;
  AttachmentFolder setting_files;
  struct Session {
    std::string id;
    AttachmentFolder files;
    int steps = 0;  ///< put so far
  };
  std::optional<Session> session;  ///< that goes on
  std::set<std::string> answered;  ///< what the running program was asked before
  int repeated = 0;                ///< lines passed over since the problem was put
  Clock::time_point last_look{}, last_look_at_mappings{};
  double shared_mb = 0;      ///< in mappings, as last seen
  double cpu_s = 0;          ///< of the running program, as last seen
  double cpu_charged_s = 0;  ///< of that, told in earlier replies
  double peak_mb = 0;        ///< since the problem was put

  struct Failures {
    int times = 0;  ///< in a row
    Failure last;
  };
  std::map<std::string, Failures> failures;  ///< by what was attempted
};

/// Tries a step that is the same for many problems, unless it has failed too often in a row.
template <typename Act>
Outcome<void> OutsideMethod::State::Attempt(const std::string& what, Act act) {
  Failures& failed = failures[what];
  if (failed.times == kMostFailures) return tl::unexpected(failed.last);
  Outcome<void> done = act();
  if (done) {
    failed.times = 0;
    return done;
  }
  ++failed.times;
  failed.last = {done.error().status, fmt::format("{}: {}", what, done.error().reason), done.error().was_asked};
  return tl::unexpected(failed.last);
}

/// Makes the program run and know the setting.
Outcome<void> OutsideMethod::State::MakeReady(const std::string& setting_id, const Payload& setting) {
  EndSession();
  if (!options.seed.IsPlain() && setting_in_force && setting_in_force != setting_id) Stop(kEndingMs);
  if (!child) {
    RETURN_IF_ERROR(Attempt("in its start", [&] { return Start(); }));
  }
  if (setting_in_force != setting_id) {
    RETURN_IF_ERROR(Attempt("at setting " + Printable(setting_id), [&] { return TellSetting(setting_id, setting); }));
  }
  return {};
}

Outcome<void> OutsideMethod::State::Begin(const std::string& setting_id, const Payload& setting,
                                          const std::string& name, const Payload& begin) {
  RETURN_IF_ERROR(MakeReady(setting_id, setting));
  const std::string id = IdOf('p', name);
  auto files = AttachmentFolder::Write(attachment_root->path(), begin.files);
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
  const auto files = AttachmentFolder::Write(attachment_root->path(), step.files);
  if (!files) return NotAsked(files.error());
  const auto line = StepLine(session->id, number, *step.json, files->path());
  if (!line) return OurFailure(line.error());
  const auto read = [&](const std::string& said) -> Result<Json> {
    auto answer = ReadStepAnswer(said, session->id, number);
    if (!answer) return Fail({}, "at step {}: {}", number, answer.error().message);
    return answer;
  };
  return Exchange(*line, options.time_s, read, Looks::kNowAndThen);
}

Outcome<Json> OutsideMethod::State::Solve(const std::string& setting_id, const Payload& setting,
                                          const std::string& name, const Payload& problem) {
  RETURN_IF_ERROR(MakeReady(setting_id, setting));
  const std::string problem_id = IdOf('p', name);
  const auto files = AttachmentFolder::Write(attachment_root->path(), problem.files);
  if (!files) return NotAsked(files.error());
  const auto line = ProblemLine(problem_id, *problem.json, files->path());
  if (!line) return OurFailure(line.error());
  const auto read = [&](const std::string& said) { return ReadAnswer(said, problem_id); };
  RETURN_IF_ERROR(HearBefore(read));  // it may be put again, and what has come till now answers its last time
  answered.erase(problem_id);
  auto answer = Exchange(*line, options.time_s, read);
  answered.insert(problem_id);
  return answer;
}

Outcome<void> OutsideMethod::State::Start() {
  if (options.command.empty()) return Failed(Status::kFailed, "no program is named");
  const auto told = options.options_json.empty() ? Json::object() : ReadJson(options.options_json, "its options");
  if (!told) return OurFailure(told.error());
  const auto hello = HelloLine(options.task, *told);
  if (!hello) return OurFailure(hello.error());
  if (!attachment_root) {
    auto made = TemporaryFolder::Make("files");
    if (!made) return NotAsked(made.error());
    attachment_root.emplace(std::move(*made));
  }
  std::vector<std::string> command = options.command;
  auto program = FindProgram(command.front());
  if (!program) return NotAsked(program.error());
  command.front() = std::move(*program);
  ProgramView view = ViewOf(command, options.files);
  view.shown.emplace_back(attachment_root->path());
  std::vector<std::string> environment;
  if (const std::filesystem::path python = PythonFolder(); !python.empty()) {
    view.shown.push_back(python / "etude");
    environment.push_back("PYTHONPATH=" + python.string());
  }
  const FencedCommand fenced = options.fence.Around(view.command, view.shown, view.start);
  auto started = ChildProcess::Start({.program = fenced.words.front(),
                                      .arguments = {fenced.words.begin() + 1, fenced.words.end()},
                                      .error_file = errors.path(),
                                      .limited = true,
                                      .contained = options.fence.IsUp(),
                                      .told = fenced.told,
                                      .environment = std::move(environment)});
  if (!started) return NotAsked(started.error());
  child = std::move(*started);
  answered.clear();
  cpu_s = cpu_charged_s = shared_mb = 0;
  last_look_at_mappings = {};
  auto reply = Exchange(*hello, StartSeconds(), ReadHello);
  const bool ended = !reply && (reply.error().status == Status::kCrashed || reply.error().status == Status::kFailed);
  if (ended) {  // or was it the fence?
    if (auto tried = options.fence.Try(); !tried) return NotAsked(tried.error());
    reply.error().reason += kHint;
  }
  if (!reply) return tl::unexpected(std::move(reply).error());
  program_name = reply->name + " " + reply->version;
  return {};
}

Outcome<void> OutsideMethod::State::TellSetting(const std::string& id, const Payload& setting) {
  auto files = AttachmentFolder::Write(attachment_root->path(), setting.files);
  if (!files) return NotAsked(files.error());
  setting_files = std::move(*files);
  const auto line = SettingLine(IdOf('s', id), *setting.json, setting_files.path());
  if (!line) return OurFailure(line.error());
  RETURN_IF_ERROR(Exchange(*line, StartSeconds(), ReadReady));
  setting_in_force = id;
  return {};
}

/// Hears what was said since the last reply: answers given again are passed over, one to the question to come is
/// refused.
template <typename Read>
Outcome<void> OutsideMethod::State::HearBefore(Read read) {
  child->Receive(kLongestReply);
  while (const auto said = child->NextLine()) {
    if (!IsRepeated(*said)) {
      const auto reply = read(WithoutFolder(*said));
      return BadOutput(reply ? TooEarly() : reply.error());
    }
    ++repeated;
  }
  return {};
}

/// Says a line and gives what `read` makes of the reply.
template <typename Read>
auto OutsideMethod::State::Exchange(const std::string& line, double seconds, Read read, Looks looks)
    -> Outcome<typename decltype(read(line))::value_type> {
  const auto limit = std::chrono::duration<double>(std::min(seconds, kLongestS));
  const auto deadline = Clock::now() + std::chrono::duration_cast<Clock::duration>(limit);
  RETURN_IF_ERROR(HearBefore(read));
  child->Send(line);  // one that no longer listens is noticed by its silence
  while (true) {
    const auto said = WaitForLine(deadline, seconds);
    if (!said) return tl::unexpected(said.error());
    auto reply = read(*said);
    if (!reply && IsRepeated(*said)) {
      if (Clock::now() >= deadline) return tl::unexpected(TooLong(seconds));
      ++repeated;
      continue;
    }
    if (!reply) {
      const auto again = read(WithoutFolder(*said));
      return BadOutput((again ? reply : again).error());
    }
    if (child->UnreadBytes() > line.size()) return BadOutput(TooEarly());
    if (looks == Looks::kAlways || Clock::now() >= last_look + kLookEvery) {
      RETURN_IF_ERROR(Look());
    }
    if constexpr (std::is_void_v<typename decltype(reply)::value_type>) {
      return {};
    } else {
      return std::move(*reply);
    }
  }
}

/// Tells whether a line answers what has an answer. When it comes must not matter: it may come with the first answer,
/// or only after the next question.
bool OutsideMethod::State::IsRepeated(const std::string& line) const {
  const Answered about = QuestionAnsweredBy(line);
  if (session && about.id == session->id) return about.step && *about.step < session->steps - 1;
  return answered.contains(about.id);
}

Outcome<std::string> OutsideMethod::State::WaitForLine(Clock::time_point deadline, double seconds) {
  Clock::time_point next_look = Clock::now() + kLookEvery;
  while (true) {
    if (auto line = child->NextLine()) return std::move(*line);
    if (Clock::now() >= deadline) return tl::unexpected(TooLong(seconds));
    const auto patience = std::chrono::ceil<std::chrono::milliseconds>(std::min(next_look, deadline) - Clock::now());
    std::array<pollfd, 2> watched{
        {{child->output(), POLLIN, 0}, {child->HasUnsent() ? child->input() : -1, POLLOUT, 0}}};
    ::poll(watched.data(), watched.size(), std::max(0, static_cast<int>(patience.count())));
    bool over = false;
    const bool looks = Clock::now() >= next_look;
    if (looks) {
      RETURN_IF_ERROR(Look());
      next_look = Clock::now() + kLookEvery;
      over = child->HasEnded();  // what it has started may keep its output open
    }
    if (over || watched[0].revents != 0 || watched[1].revents != 0) {
      over = !child->Receive(kLongestReply) || over;
    }
    if (over && child->PartOfLine().find('\n') == std::string_view::npos) return tl::unexpected(HowItEnded());
  }
}

/// Notes what it uses; fails when that is too much.
Outcome<void> OutsideMethod::State::Look() {
  last_look = Clock::now();
  errors.Trim();
  ProcessUsage usage = child->Measure();
  if (last_look >= last_look_at_mappings + kLookAtMappingsEvery) {
    last_look_at_mappings = last_look;
    shared_mb = child->MeasureSharedMappingsMb();
  }
  usage.resident_mb += shared_mb + options.fence.ScratchMb(child->FirstStarted());
  cpu_s = std::max(cpu_s, usage.cpu_s);  // it may have vanished meanwhile
  peak_mb = std::max(peak_mb, usage.resident_mb);
  if (usage.resident_mb > options.memory_mb) {
    return Failed(Status::kOutOfMemory, fmt::format("held more than {:g} MB of memory", options.memory_mb));
  }
  if (usage.processes <= ProgramLimits::kProcesses) return {};
  return Failed(Status::kOutOfMemory, fmt::format("held more than {} processes", ProgramLimits::kProcesses));
}

/// Says how a program ended from which no whole line will come any more.
Failure OutsideMethod::State::HowItEnded() {
  const std::string part = WithoutFolder(std::string(child->PartOfLine().substr(0, 1000))).substr(0, 100);
  if (child->PartOfLine().size() > kLongestReply) {
    return {Status::kBadOutput,
            fmt::format("said a line of more than {} MiB: {}", kLongestReply >> 20, Printable(part))};
  }
  for (int i = 0; i < kDyingMs && !child->HasEnded(); ++i) ::usleep(1000);
  if (!child->HasEnded()) return {Status::kBadOutput, "closed its output, but went on running"};
  const std::string end = child->Finish(0);
  std::string reason = "ended with " + end;
  if (!part.empty()) reason += ", amid the line " + Printable(part);
  if (const std::string words = WithoutFolder(errors.LastLine()); !words.empty()) {
    reason += "; its last words: " + Printable(words, 200);
  }
  // An exit code is the program's own word, an exception for instance; a signal may be the machine's.
  return {end.starts_with("exit code") ? Status::kFailed : Status::kCrashed, std::move(reason)};
}

/// Ends the session: what the program says of it counts as said again.
void OutsideMethod::State::EndSession() {
  if (session) answered.insert(session->id);
  session.reset();
}

std::string OutsideMethod::State::Stop(int patience_ms) {
  session.reset();
  setting_files = {};  // deleted first: we may be killed while we wait for the program to end
  setting_in_force.reset();
  std::string end = child ? child->Finish(patience_ms) : "not running";
  child.reset();
  return end;
}

double LongestAskSeconds(double time_s) {
  return 2 * std::max(OutsideOptions{}.start_s, time_s) + time_s + 2 * 1e-3 * kDyingMs;
}

OutsideMethod::OutsideMethod(OutsideOptions options) : state_(std::make_unique<State>(std::move(options))) {}
OutsideMethod::OutsideMethod(OutsideMethod&&) noexcept = default;

OutsideMethod::~OutsideMethod() {
  if (state_ != nullptr) state_->Stop(kEndingMs);
}

OutsideReply OutsideMethod::Ask(const std::string& setting_id, const Payload& setting, const std::string& problem_id,
                                const Payload& problem) {
  state_->peak_mb = 0;
  OutsideReply reply = state_->ReplyOf(state_->Solve(setting_id, setting, problem_id, problem));
  state_->errors.Save();
  return reply;
}

OutsideReply OutsideMethod::Begin(const std::string& setting_id, const Payload& setting, const std::string& session_id,
                                  const Payload& session) {
  state_->peak_mb = 0;
  auto begun = state_->Begin(setting_id, setting, session_id, session);
  OutsideReply reply = state_->ReplyOf(begun ? Outcome<Json>(Json{{"type", "answer"}, {"answer", Json::object()}})
                                             : tl::unexpected(begun.error()));
  state_->errors.Save();
  return reply;
}

OutsideReply OutsideMethod::Step(const Payload& step) {
  assert(state_->session.has_value());
  OutsideReply reply = state_->ReplyOf(state_->Step(step));
  if (reply.status == Status::kOk) return reply;
  state_->EndSession();
  state_->errors.Save();
  return reply;
}

/// What a program says of its attachments would be another reason every time, by where they lay.
std::string OutsideMethod::State::WithoutFolder(std::string text) const {
  if (!attachment_root) return text;
  const std::string folder = attachment_root->path().string();
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
    const std::size_t own = at + folder.size();  // below it, each has a folder of its own
    const bool is_named = own < text.size() && text[own] == '/';
    text.replace(at, folder.size() + (is_named ? 1 + AttachmentFolder::kNameLength : 0), "FILES");
  }
  return text;
}

/// Stops a program that gave no answer that can be read; charges what it used.
OutsideReply OutsideMethod::State::ReplyOf(Outcome<Json> said) {
  if (!said) Stop(0);
  OutsideReply reply;
  reply.cpu_s = cpu_s - cpu_charged_s;
  reply.peak_mb = peak_mb;
  reply.repeated = std::exchange(repeated, 0);
  cpu_charged_s = cpu_s;
  if (!said) {
    reply.status = said.error().status;
    reply.reason = said.error().reason;
    reply.was_asked = said.error().was_asked;
  } else if ((*said)["type"] == "no_answer") {
    reply.status = Status::kUnsolved;
    const std::string why = (*said)["reason"].get<std::string>();
    reply.reason = "gave no answer: " + Printable(WithoutFolder(why), 200);
  } else {
    reply.status = Status::kOk;
    reply.answer = std::make_unique<Json>(std::move((*said)["answer"]));
  }
  return reply;
}

std::string OutsideMethod::ProgramName() const { return state_->program_name; }

std::string OutsideMethod::End(int patience_ms) { return state_->Stop(patience_ms); }

}  // namespace etude
