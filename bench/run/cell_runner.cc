#include "bench/run/cell_runner.h"

#include <algorithm>
#include <exception>
#include <fstream>
#include <new>
#include <nlohmann/json.hpp>

#include "bench/outside/seated_program.h"
#include "bench/run/machine_trial.h"
#include "bench/run/outside_programs.h"
#include "engine/base/digest.h"

namespace etude {
namespace {

double CpuSeconds() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

class Stopwatch {
 public:
  double WallSeconds() const { return SecondsSince(start_); }
  double CpuSecondsUsed() const { return CpuSeconds() - cpu_start_; }

 private:
  const Clock::time_point start_ = Clock::now();
  const double cpu_start_ = CpuSeconds();
};

/// Resets the peak memory that the kernel has recorded for this process.
void ForgetPeakMemory() { std::ofstream("/proc/self/clear_refs") << "5"; }

double ReadPeakMemoryMb() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::stod(line.substr(6)) / 1024;
  }
  return 0;
}

/// Returns true if the exception means that memory ran out. An exception about an impossible array length is a bug
/// instead.
bool IsShortage(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr &&
         dynamic_cast<const std::bad_array_new_length*>(&error) == nullptr;
}

}  // namespace

Result<CellResult> JudgeAnswer(TaskWorld& world, const Json& answer) {
  ASSIGN_OR_RETURN(auto judged, world.Judge(answer));
  judged.digests.emplace_back("answer", Digest().Add(std::string_view(answer.dump())).Hex());
  return judged;
}

void CellRunner::PeakMemory::Begin() {
  const auto now = Clock::now();
  if (now < looked_ + kLookEvery) return;
  ForgetPeakMemory();
  mb_ = 0;
}

double CellRunner::PeakMemory::Mb() {
  const auto now = Clock::now();
  if (mb_ > 0 && now < looked_ + kLookEvery) return mb_;
  looked_ = now;
  return mb_ = ReadPeakMemoryMb();
}

CellRunner::CellRunner(const PreparedScenario& scenario, std::string error_folder, const Fence& fence)
    : scenario_(scenario), error_folder_(std::move(error_folder)), metrics_(scenario, error_folder_, fence) {
  const Scenario& told = scenario.scenario();
  for (std::size_t m = 0; m < told.methods.size(); ++m) {
    const MethodEntry& method = told.methods[m];
    if (method.exec.empty()) continue;
    outside_.emplace(m, OutsideMethod(OptionsOf(scenario, {&method}, error_folder_, fence)));
  }
}

CellRunner::~CellRunner() = default;

void CellRunner::Open(int condition, int trial) {
  condition_ = condition;
  trial_ = trial;
  problem_.reset();
  why_not_run_.clear();
  why_world_not_run_.clear();
  const Stopwatch watch;
  const WorldKey key = scenario_.KeyOf(condition, trial);
  try {
    const bool keeps_motion = !metrics_.empty() || scenario_.scenario().recordings.KeepsTrial(trial);
    world_ = scenario_.task(condition).MakeWorld(key, keeps_motion);
    const auto& methods = scenario_.scenario().methods;
    const bool runs_built_in = std::ranges::any_of(methods, &MethodEntry::RunsInTask);
    if (runs_built_in && !world_->WhySkipped()) world_->PrepareShared();
  } catch (const std::exception& error) {
    world_.reset();
    why_no_world_ = Thrown("the world cannot be built: ", error);
    why_world_not_run_ = why_not_run_;
  }
  world_usage_ = {.world_wall_s = watch.WallSeconds(), .world_cpu_s = watch.CpuSecondsUsed()};
}

FinishedCell CellRunner::Run(std::size_t method) {
  FinishedCell cell{scenario_.IdentityOf(condition_, trial_, method), std::exchange(world_usage_, {})};
  peak_memory_.Begin();
  why_not_run_.clear();
  const Stopwatch watch;
  try {
    cell.row.result = RunMethod(method, cell.usage);
  } catch (const std::exception& error) {
    cell.row.result = Thrown("the method threw: ", error);
  }
  cell.usage.wall_s = watch.WallSeconds();
  cell.usage.cpu_s += watch.CpuSecondsUsed();
  cell.usage.peak_mb = std::max(cell.usage.peak_mb, peak_memory_.Mb());
  cell.why_not_run = why_not_run_;
  cell.is_measured = metrics_.empty() || !cell.row.result.recording;
  if (cell.is_measured) Complete(condition_, cell.row);
  return cell;
}

CellResult CellRunner::Thrown(const std::string& when, const std::exception& error) {
  if (!IsShortage(error)) return CellResult::Ended(Status::kFailed, when + error.what());
  const double limit_mb = scenario_.scenario().limits.memory_mb;
  if (ReadPeakMemoryMb() > limit_mb) {
    return CellResult::Ended(Status::kOutOfMemory, fmt::format("{}held more than {:g} MB of memory", when, limit_mb));
  }
  why_not_run_ =
      fmt::format("the machine's memory ran out before the worker held the {:g} MB that the scenario allows", limit_mb);
  return {};
}

FinishedCell CellRunner::Measure(int condition, FinishedCell answered) {
  answered.why_not_run = metrics_.Measure(answered.row.Id(), answered.row.result);
  answered.is_measured = true;
  Complete(condition, answered.row);
  return answered;
}

void CellRunner::Complete(int condition, Row& row) const {
  const RecordingSelection& kept = scenario_.scenario().recordings;
  if (!kept.KeepsTrial(row.trial) || !kept.KeepsMethod(row.method)) row.result.recording.reset();
  scenario_.CompleteMetrics(condition, row);
}

CellResult CellRunner::RunMethod(std::size_t method, CellUsage& usage) {
  if (!world_) {
    why_not_run_ = why_world_not_run_;
    return why_no_world_;
  }
  if (const auto why = world_->WhySkipped()) return CellResult::Ended(Status::kSkipped, *why);
  if (auto tried = TryRenderer(scenario_); !tried) {
    why_not_run_ = ToString(tried.error());
    return {};
  }
  if (!outside_.contains(method)) return world_->Run(IndexInTask(method));
  return scenario_.scenario().methods[method].RunsInTask() ? RunWithProgram(method, usage) : AskOutside(method, usage);
}

std::size_t CellRunner::IndexInTask(std::size_t method) const {
  const auto& methods = scenario_.scenario().methods;
  return static_cast<std::size_t>(std::count_if(methods.begin(), methods.begin() + method,
                                                [](const MethodEntry& other) { return other.RunsInTask(); }));
}

std::string CellRunner::SettingId() const {
  const std::string condition =
      scenario_.scenario().name + "/" + CompactLabel(scenario_.scenario().conditions[condition_].swept);
  return scenario_.task(condition_).HasOwnSettings() ? fmt::format("{}/{}", condition, trial_) : condition;
}

tl::expected<const Payload*, CellResult> CellRunner::OpenSetting() {
  const Task& task = scenario_.task(condition_);
  if (setting_ == nullptr || condition_of_setting_ != condition_ ||
      (task.HasOwnSettings() && trial_of_setting_ != trial_)) {
    auto setting = task.HasOwnSettings() ? world_->MakeSetting() : task.Setting();
    if (!setting) return tl::unexpected(CellResult::Ended(Status::kFailed, ToString(setting.error())));
    setting_ = std::make_unique<Payload>(std::move(*setting));
    condition_of_setting_ = condition_;
    trial_of_setting_ = trial_;
  }
  return setting_.get();
}

std::string CellRunner::WhyNotAsked(std::size_t method, const std::string& reason) const {
  const Scenario& scenario = scenario_.scenario();
  return fmt::format("method {} of {}: {}", scenario.methods[method].name, scenario.name, reason);
}

CellResult CellRunner::RunWithProgram(std::size_t method, CellUsage& usage) {
  const auto setting = OpenSetting();
  if (!setting) return setting.error();
  SeatedProgram program(outside_.at(method), SettingId(), **setting, fmt::format("{}/{}", SettingId(), trial_));
  auto result = world_->RunWith(program, IndexInTask(method));
  program.End();
  usage.cpu_s += program.cpu_s();
  usage.peak_mb = program.peak_mb();
  if (!program.was_asked()) why_not_run_ = WhyNotAsked(method, program.failure()->reason);
  if (program.failure()) return *program.failure();
  if (!result) return CellResult::Ended(Status::kBadOutput, ToString(result.error()));
  result->digests.emplace_back("answers", program.AnswersDigest());
  return std::move(*result);
}

CellResult CellRunner::AskOutside(std::size_t method, CellUsage& usage) {
  const auto setting = OpenSetting();
  if (!setting) return setting.error();
  if (problem_ == nullptr) {
    auto problem = world_->MakeProblem();
    if (!problem) return CellResult::Ended(Status::kFailed, ToString(problem.error()));
    problem_ = std::make_unique<Payload>(std::move(*problem));
  }
  const std::string problem_id = fmt::format("{}/{}", SettingId(), trial_);
  const OutsideReply reply = outside_.at(method).Ask(SettingId(), **setting, problem_id, *problem_);
  usage.cpu_s += reply.cpu_s;
  usage.peak_mb = reply.peak_mb;
  if (!reply.was_asked) why_not_run_ = WhyNotAsked(method, reply.reason);
  if (reply.status != Status::kOk) return CellResult::Ended(reply.status, reply.reason);
  auto judged = JudgeAnswer(*world_, *reply.answer);
  if (!judged) return CellResult::Ended(Status::kBadOutput, ToString(judged.error()));
  return std::move(*judged);
}

}  // namespace etude
