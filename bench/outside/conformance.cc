#include "bench/outside/conformance.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

#include "bench/outside/messages.h"
#include "bench/outside/seated_program.h"
#include "bench/tasks/registry.h"
#include "engine/base/angles.h"
#include "engine/base/named.h"
#include "engine/base/names.h"
#include "engine/document/node.h"
#include "engine/teaching/labelled_streams.h"
#include "io/clips/clip_library.h"
#include "io/process/clock.h"

namespace etude {
namespace {

constexpr int kProblems = 3;

/// The data from which a task's specimens (small worlds for tests) are made, with an easy and a harder condition.
struct Recipe {
  const char* task;
  std::vector<std::string> clips;
  std::array<const char*, 2> conditions;
  const char* plain_method = "";  ///< a built-in method that solves some worlds; "" if every method of the task solves
                                  ///< some
};

const std::vector<Recipe>& Recipes() {
  static const std::vector<Recipe> recipes = {
      {"transition", {"builtin:clap", "builtin:sway", "builtin:boxing"}, {"{wait_s: 1}", "{wait_s: 3}"}},
      {"detection", {"builtin:clap", "builtin:sway"}, {"{events: 4}", "{events: 8, noise: 2}"}},
      {"ik", {}, {"{joint_noise_deg: 5}", "{joint_noise_deg: 15}"}, "{name: plain, solver: damped-least-squares}"},
      {"tracking",
       {"builtin:clap"},
       {"{duration_s: 0.2}", "{duration_s: 0.4, rate_hz: 15}"},
       "{name: plain, solver: damped-least-squares}"},
      {"pose-distance",
       {"builtin:clap", "builtin:sway"},
       {"{pairs: blindspots}", "{pairs: frames, pairs_per_world: 5}"}},
      {"capture", {"builtin:clap"}, {"{duration_s: 0.1}", "{duration_s: 0.1, clothes: everyday}"}},
      {"inbetween",
       {},
       {"{truth: ['builtin:songs'], training: ['builtin:clap'], window: 30, gap: 5}",
        "{truth: ['builtin:songs'], training: ['builtin:clap'], window: 40, gap: 15, given: 2}"}},
      {"coach", {}, {"{session_s: 10, people: adult}", "{session_s: 12, people: adult, noise: 2, song: sprint}"}}};
  return recipes;
}

/// Returns the recipe for worlds of recorded people. It has no clips, and its two conditions are empty.
Recipe OfRecordings(const Recipe& recipe) { return {recipe.task, {}, {"{}", "{}"}}; }

Result<Specimen> MakeSpecimen(const TaskKind& kind, const Recipe& recipe, std::size_t index, const std::string& seat,
                              const LabelledStreams* recordings) {
  Specimen specimen;
  const std::string condition = recipe.conditions[index];
  const std::string setting_id =
      fmt::format("{} {}{}", kind.name, condition, index == 0 || condition != "{}" ? "" : " again");
  // Make the task from the recipe's clips, the condition and one method.
  ASSIGN_OR_RETURN(auto clips, LoadClips(recipe.clips, {}));
  specimen.clips = std::make_unique<ClipLibrary>(std::move(clips));
  ASSIGN_OR_RETURN(const auto node, ParseYaml(condition, setting_id));
  Fields fields(node, "a specimen of task " + kind.name);
  std::vector<Node> methods;
  const std::string method = seat.empty() ? recipe.plain_method : "{name: specimen, seat: " + seat + "}";
  if (!method.empty()) {
    ASSIGN_OR_RETURN(methods.emplace_back(), ParseYaml(method, setting_id));
  }
  specimen.has_plain_method = seat.empty() && !method.empty();
  TaskInput input{fields, methods, *specimen.clips};
  input.recordings = recordings;
  FoundFiles found;
  if (kind.find_files != nullptr) {
    ASSIGN_OR_RETURN(found, kind.find_files(node, methods, {}));
    input.files = found.worlds;
  }
  ASSIGN_OR_RETURN(auto task, kind.make(input));
  specimen.task = std::move(task);
  std::shared_ptr<const Payload> shared;
  if (!specimen.task->HasOwnSettings()) {
    ASSIGN_OR_RETURN(auto setting, specimen.task->Setting());
    shared = std::make_shared<const Payload>(std::move(setting));
  }
  // Make the problems.
  const int problems =
      recordings == nullptr ? kProblems : std::min(kProblems, static_cast<int>(recordings->people.size()));
  for (int trial = 0; trial < problems; ++trial) {
    SpecimenProblem problem{.id = fmt::format("{} {}", setting_id, trial),
                            .setting_id = setting_id,
                            .setting = shared,
                            .world = specimen.task->MakeWorld({1, "check-method", trial}, false),
                            .problem = {}};
    if (const auto why = problem.world->WhySkipped()) return Fail({}, "{}", *why);
    if (shared == nullptr) {
      ASSIGN_OR_RETURN(auto own, problem.world->MakeSetting());
      problem.setting = std::make_shared<const Payload>(std::move(own));
      problem.setting_id = problem.id;
    }
    if (seat.empty()) {
      ASSIGN_OR_RETURN(problem.problem, problem.world->MakeProblem());
    }
    specimen.problems.push_back(std::move(problem));
  }
  return specimen;
}

constexpr int kMaxEndingMs = 2000;

/// The result of asking a method once, in a comparable form: its answer, or the reason why it gave none.
struct Attempt {
  Status status = Status::kFailed;
  std::string said;
  std::string fault;    ///< why this result is not allowed; "" = it is allowed
  bool was_put = true;  ///< false: the program could not be started, or ended instead of answering
};

/// Returns a copy of an answer in which all angles (numbers below keys that end in "_deg") are multiplied by `factor`.
Json WithAngles(const Json& answer, double factor, bool is_angle = false) {
  if (answer.is_number()) return is_angle ? Json(answer.get<double>() * factor) : answer;
  if (!answer.is_structured()) return answer;
  Json changed = answer;
  for (auto& [key, value] : changed.items()) {
    value = WithAngles(value, factor, is_angle || (answer.is_object() && key.ends_with("_deg")));
  }
  return changed;
}

/// A program that replaces a part of a world's loop (its seat). It receives additional keys, which the protocol does
/// not define.
class ProgramWithUnknownKeys final : public SeatedProgram {
 public:
  using SeatedProgram::SeatedProgram;
  bool Begin(const Payload& session) override {
    Payload shown = PayloadOf(*session.json, session.files);
    (*shown.json)["of_a_later_version"] = std::string(2'000'000, 'x');
    return SeatedProgram::Begin(shown);
  }
  JsonPtr Step(const Payload& step) override {
    Payload shown = PayloadOf(*step.json, step.files);
    (*shown.json)["of_a_later_version"] = true;
    return SeatedProgram::Step(shown);
  }
};

class ConformanceTest {
 public:
  ConformanceTest(const OutsideOptions& options, bool takes_seat, const std::vector<Specimen>& specimens,
                  const std::function<void(const ConformanceCheck&)>& report)
      : method_(options), takes_seat_(takes_seat), time_s_(options.time_s), specimens_(specimens), report_(report) {}

  Result<bool> Run() {
    RETURN_IF_ERROR(CheckAnswers());
    if (!all_passed_) return false;
    CheckOneProblemTwice();
    CheckOrder();
    CheckSettings();
    CheckLongLines();
    Report("answers every question once", repeated_ == 0,
           repeated_ == 0 ? "no answer was repeated" : fmt::format("{} answers were repeated", repeated_));
    const std::string end = method_.End(kMaxEndingMs);
    Report("ends when its input ends", end == "exit code 0",
           end == "signal 9 (Killed)"
               ? fmt::format("the program was still running {} s after its input ended", kMaxEndingMs / 1000)
               : end);
    if (solves_nothing_ && specimens_[0].has_plain_method) CheckAgainstPlain();
    return all_passed_;
  }

 private:
  void Report(const std::string& name, bool passed, const std::string& found) {
    all_passed_ = all_passed_ && passed;
    report_({name, passed, found});
  }

  Attempt Ask(const SpecimenProblem& problem) {
    if (takes_seat_) return Play<SeatedProgram>(problem, problem.id);
    return Ask(problem, problem.id, problem.problem);
  }

  Attempt Ask(const SpecimenProblem& problem, const std::string& id, const Payload& shown) {
    const auto start = Clock::now();
    const OutsideReply reply = method_.Ask(problem.setting_id, *problem.setting, id, shown);
    slowest_s_ = std::max(slowest_s_, SecondsSince(start));
    peak_mb_ = std::max(peak_mb_, reply.peak_mb);
    repeated_ += reply.repeated;
    Attempt attempt{reply.status, reply.reason, "", reply.was_asked && reply.status != Status::kFailed};
    if (reply.status == Status::kOk) {
      attempt.said = reply.answer->dump();
      const auto judged = problem.world->Judge(*reply.answer);
      attempt.status = judged ? judged->status : Status::kBadOutput;
      if (!judged) attempt.fault = "its answer cannot be scored: " + judged.error().message;
    } else if (reply.status != Status::kUnsolved) {
      attempt.fault = fmt::format("{}: {}", StatusName(reply.status), reply.reason);
    }
    return attempt;
  }

  /// Runs a whole session in which the program does its part of the world's loop (TaskKind::seats). The result contains
  /// the digest of the program's answers.
  template <typename Program>
  Attempt Play(const SpecimenProblem& problem, const std::string& id) {
    const auto start = Clock::now();
    Program program(method_, problem.setting_id, *problem.setting, id);
    const auto result = problem.world->RunWith(program, 0);
    program.End();
    slowest_s_ = std::max(slowest_s_, SecondsSince(start));
    peak_mb_ = std::max(peak_mb_, program.peak_mb());
    repeated_ += program.repeated();
    if (const auto& failure = program.failure()) {
      Attempt attempt{failure->status, failure->reason, "", program.was_asked() && failure->status != Status::kFailed};
      if (failure->status != Status::kUnsolved) {
        attempt.fault = fmt::format("{}: {}", StatusName(failure->status), failure->reason);
      }
      return attempt;
    }
    Attempt attempt{result ? result->status : Status::kBadOutput, "answers " + program.AnswersDigest(), "", true};
    if (!result) attempt.fault = "its answers cannot be used: " + result.error().message;
    return attempt;
  }

  Result<void> CheckAnswers() {
    int solved = 0;
    for (const SpecimenProblem& problem : specimens_[0].problems) {
      first_.push_back(Ask(problem));
      const Attempt& attempt = first_.back();
      if (first_.size() == 1) {
        const std::string name = method_.ProgramName();
        if (!attempt.was_put && name.empty()) return Fail({}, "{}", attempt.said);
        Report("starts and greets", !name.empty(), name.empty() ? attempt.fault : Printable(name));
        if (name.empty()) return {};
      }
      if (!attempt.fault.empty() || !attempt.was_put) {
        Report("gives answers that can be scored", false, attempt.was_put ? attempt.fault : attempt.said);
        return {};
      }
      solved += attempt.status == Status::kOk ? 1 : 0;
    }
    Report(
        "gives answers that can be scored", true,
        fmt::format(
            "{} of {} answers solve their problem; slowest answer: {:.3g} s (allowed: {:g} s), most memory: {:.0f} MB",
            solved, first_.size(), slowest_s_, time_s_, peak_mb_));
    solves_nothing_ = solved == 0;
    return {};
  }

  /// If the method solved no problem, but a plain built-in method solves some of the problems, reports a failed check.
  /// Also tests whether the method's angles are in radians.
  void CheckAgainstPlain() {
    int plain = 0, in_radians = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      TaskWorld& world = *specimens_[0].problems[i].world;
      plain += world.Run(0).status == Status::kOk ? 1 : 0;
      const Json answer = Json::parse(first_[i].said, nullptr, false);
      if (first_[i].status != Status::kUnsolved || !answer.is_object()) continue;
      const auto judged = world.Judge(WithAngles(answer, Degrees(1)));
      in_radians += judged && judged->status == Status::kOk ? 1 : 0;
    }
    if (plain == 0) return;
    const std::string unit =
        in_radians == 0
            ? ""
            : fmt::format("; if its angles are read as radians, they solve {}, so convert the angles to degrees",
                          in_radians);
    Report("solves the problems that a simple method solves", false,
           fmt::format("the program solves none of {} problems; the built-in method damped-least-squares solves {}{}",
                       first_.size(), plain, unit));
  }

  /// Compares a second attempt at problem `i` of the first setting with the first attempt. Returns the difference; ""
  /// if they are equal.
  std::string Compare(const Attempt& again, std::size_t i) const {
    if (!again.fault.empty()) return again.fault;
    if (again.said == first_[i].said) return "";
    std::size_t at = 0;
    while (at < again.said.size() && at < first_[i].said.size() && again.said[at] == first_[i].said[at]) ++at;
    at = at > 20 ? at - 20 : 0;
    return fmt::format("first {}, then {}",
                       Printable(std::string_view(first_[i].said).substr(std::min(at, first_[i].said.size())), 40),
                       Printable(std::string_view(again.said).substr(std::min(at, again.said.size())), 40));
  }

  void ReportDifference(const std::string& name, const std::string& difference) {
    Report(name, difference.empty(), difference.empty() ? "the same answers" : difference);
  }

  void CheckOneProblemTwice() {
    const std::size_t last = first_.size() - 1;
    ReportDifference("gives the same answer to a repeated problem", Compare(Ask(specimens_[0].problems[last]), last));
  }

  void CheckOrder() {
    method_.End(kMaxEndingMs);
    std::string difference;
    for (std::size_t i = first_.size(); i-- > 0 && difference.empty();) {
      difference = Compare(Ask(specimens_[0].problems[i]), i);
    }
    ReportDifference("gives the same answers after a restart and in another order", difference);
  }

  void CheckSettings() {
    std::string fault;
    for (const SpecimenProblem& problem : specimens_[1].problems) {
      if (fault.empty()) fault = Ask(problem).fault;
    }
    Report("answers problems with another setting", fault.empty(),
           fault.empty() ? "answers that can be scored" : fault);
    if (fault.empty()) {
      ReportDifference("gives the same answers when the first setting is sent again",
                       Compare(Ask(specimens_[0].problems[0]), 0));
    }
  }

  void CheckLongLines() {
    const std::string id = "a \"long\" one, größer";
    ReportDifference("accepts long lines, unknown keys and ids with any characters", Compare(AskAtLength(id), 0));
  }

  /// Sends the first problem with additional keys that the program does not know.
  Attempt AskAtLength(const std::string& id) {
    const SpecimenProblem& problem = specimens_[0].problems[0];
    if (takes_seat_) return Play<ProgramWithUnknownKeys>(problem, id);
    Payload shown = PayloadOf(*problem.problem.json, problem.problem.files);
    (*shown.json)["of_a_later_version"] = std::string(2'000'000, 'x');
    return Ask(problem, id, shown);
  }

  OutsideMethod method_;
  const bool takes_seat_;
  const double time_s_;
  const std::vector<Specimen>& specimens_;
  const std::function<void(const ConformanceCheck&)>& report_;
  std::vector<Attempt> first_;  ///< the first attempts at the problems of the first setting
  double slowest_s_ = 0, peak_mb_ = 0;
  int repeated_ = 0;
  bool all_passed_ = true, solves_nothing_ = false;
};

}  // namespace

Result<std::vector<Specimen>> MakeSpecimens(const std::string& task, const std::string& seat,
                                            const LabelledStreams* recordings) {
  const TaskKind* kind = FindTaskKind(task);
  if (kind == nullptr) return Fail({}, "{}", UnknownName("task", task, NamesOf(Recipes(), &Recipe::task)));
  if (kind->seats.empty() && !seat.empty()) return Fail({}, "task {} has no seats for programs", task);
  if (!kind->has_problems && kind->seats.empty()) return Fail({}, "task {} runs no programs", task);
  if (seat.empty() && !kind->has_problems) {
    return Fail({}, "task {} needs one of the seats {}", task, fmt::join(kind->seats, ", "));
  }
  if (!seat.empty() && std::ranges::find(kind->seats, seat) == kind->seats.end()) {
    return Fail({}, "{}", UnknownName("seat", seat, kind->seats));
  }
  if (recordings != nullptr && !kind->uses_recordings) return Fail({}, "task {} uses no recordings", task);
  std::vector<Specimen> specimens;
  for (const Recipe& plain : Recipes()) {
    if (plain.task != task) continue;
    const Recipe recipe = recordings == nullptr ? plain : OfRecordings(plain);
    for (std::size_t i = 0; i < recipe.conditions.size(); ++i) {
      ASSIGN_OR_RETURN(auto specimen, MakeSpecimen(*kind, recipe, i, seat, recordings));
      specimens.push_back(std::move(specimen));
    }
  }
  return specimens;
}

Result<bool> CheckConformance(const OutsideOptions& options, const std::string& seat,
                              const std::function<void(const ConformanceCheck&)>& report,
                              const LabelledStreams* recordings) {
  ASSIGN_OR_RETURN(const auto specimens, MakeSpecimens(options.task, seat, recordings));
  return ConformanceTest(options, !seat.empty(), specimens, report).Run();
}

}  // namespace etude
