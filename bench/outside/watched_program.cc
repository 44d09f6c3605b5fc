#include "bench/outside/watched_program.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "bench/outside/attachment_folder.h"
#include "bench/outside/messages.h"
#include "engine/base/machine.h"
#include "io/process/process_tree.h"

namespace etude {
namespace {

constexpr long kTailBytes = 4096;  // number of bytes at the end of the output in which the last line is searched

/// Opens a log file for appending, and creates its folder. Links are not followed, because a resumed run may come from
/// somebody else.
Result<Descriptor> OpenLog(const std::filesystem::path& file) {
  const std::filesystem::path folder = file.parent_path();
  const FilePath path = Inside(folder.parent_path()) / folder.filename() / file.filename();
  return OpenFile(path, O_WRONLY | O_APPEND | O_CREAT);
}

// The interval between samples of resources, and between checks that the program still runs.
constexpr std::chrono::milliseconds kSampleInterval{20};
// The processor time for which a program that goes on computing after its reply is awaited. A limit of wall-clock time
// would make the result depend on how busy this machine is.
constexpr double kMaxRestCpu_s = 0.05;

tl::unexpected<OutsideFailure> NotStarted(const Error& error) {
  // If this machine caused the error, leave out the error's place, because the caller's message names the machine.
  return tl::unexpected<OutsideFailure>(
      {Status::kFailed, IsOfThisMachine(error) ? error.message : ToString(error), false});
}

tl::unexpected<OutsideFailure> TooMuch(std::string reason) {
  return tl::unexpected<OutsideFailure>({Status::kOutOfMemory, std::move(reason)});
}

}  // namespace

ErrorLog::ErrorLog(std::string file) : file_(std::move(file)) {
  if (file_.empty()) return;
  memory_ = ::memfd_create("standard error", MFD_CLOEXEC);
  if (memory_ >= 0) return;
  if (auto opened = OpenLog(file_)) unbuffered_ = std::move(*opened);
}

ErrorLog::~ErrorLog() {
  Save();
  if (memory_ >= 0) ::close(memory_);
}

// If the system cannot make a memory file, the log file itself is the program's standard error.
std::string ErrorLog::path() const {
  const int file = memory_ < 0 ? unbuffered_.number() : memory_;
  if (memory_ >= 0) ::fchmod(memory_, S_IRUSR | S_IWUSR);  // the last program may have changed the mode
  return file < 0 ? "" : fmt::format("/proc/{}/fd/{}", ::getpid(), file);
}

long ErrorLog::Size() const {
  struct stat status {};
  return memory_ >= 0 && ::fstat(memory_, &status) == 0 ? static_cast<long>(status.st_size) : 0;
}

// Punching a hole in the file frees memory and cannot lose output that the program appends at the same time. Truncating
// the file could lose that output, so it is done only when the file comes near the program's size limit.
void ErrorLog::Trim() {
  const long end = Size() - kTailBytes;
  if (end <= kMaxBytes) return;
  if (end < static_cast<long>(ProgramLimits::kFileBytes / 2)) {
    std::ignore = ::fallocate(memory_, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, kMaxBytes, end - kMaxBytes);
  } else {
    kept_tail_ = Tail();
    std::ignore = ::ftruncate(memory_, kMaxBytes);
  }
}

std::string ErrorLog::Read(long start, long size) const {
  std::string text(static_cast<std::size_t>(size), '\0');
  const ssize_t count = ::pread(memory_, text.data(), text.size(), start);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

// After a truncation, the first kMaxBytes of the file are older than `kept_tail_`, and all bytes behind them are newer.
std::string ErrorLog::Tail() const {
  const long size = Size();
  const long start = std::max(size - kTailBytes, kept_tail_.empty() ? 0L : kMaxBytes);
  std::string tail = kept_tail_ + Read(start, std::max(size - start, 0L));
  constexpr auto kTail = static_cast<std::size_t>(kTailBytes);
  if (tail.size() > kTail) tail.erase(0, tail.size() - kTail);
  return tail;
}

std::string ErrorLog::LastLine() const {
  std::string tail = Tail();
  const std::size_t last = tail.find_last_not_of(" \t\r\n");
  if (last == std::string::npos) return "";
  tail.resize(last + 1);
  return tail.substr(tail.find_last_of('\n') + 1);  // without a line end, npos + 1 = 0 keeps the whole tail
}

// The file is created only if there is output. If it cannot be written, the output is lost, but the cell does not fail.
void ErrorLog::Save() {
  const long size = Size();
  kept_tail_.clear();
  if (size == 0) return;
  if (const auto file = OpenLog(file_)) {
    struct stat status {};
    const long saved = ::fstat(file->number(), &status) == 0 ? static_cast<long>(status.st_size) : kMaxBytes;
    const std::string text = Read(0, std::min(size, kMaxBytes - std::min(saved, kMaxBytes)));
    std::ignore = ::write(file->number(), text.data(), text.size());
  }
  if (::ftruncate(memory_, 0) != 0) return;
}

OutsideFailure TookTooLong(double seconds) {
  return {Status::kTimeout, fmt::format("took longer than {:g} s", seconds)};
}

OutsideOutcome<void> WatchedProgram::Start() {
  if (!attachment_root_) {
    auto made = TemporaryFolder::Make("files");
    if (!made) return NotStarted(made.error());
    attachment_root_.emplace(std::move(*made));
  }
  // Find the program and the files that the sandbox shows.
  std::vector<std::string> command = options_.command;
  auto program = FindProgram(command.front());
  if (!program) return NotStarted(program.error());
  command.front() = std::move(*program);
  view_ = ViewOf(command, options_.files);
  ProgramView view = view_;
  view.shown.emplace_back(attachment_root_->path());
  std::vector<std::string> environment;
  if (const std::filesystem::path python = PythonFolder(); !python.empty()) {
    view.shown.push_back(python / "etude");
    environment.push_back("PYTHONPATH=" + python.string());
  }
  // Start the program in its sandbox and its control group.
  group_ = ControlGroup::Make(options_.fence.groups(), options_.memory_mb);
  const FencedCommand fenced = options_.fence.Around(view.command, view.shown, view.start);
  environment.insert(environment.end(), fenced.environment.begin(), fenced.environment.end());
  auto started = ChildProcess::Start({.program = fenced.words.front(),
                                      .arguments = {fenced.words.begin() + 1, fenced.words.end()},
                                      .error_file = errors_.path(),
                                      .limited = true,
                                      .contained = options_.fence.IsUp(),
                                      .programs = options_.fence.programs(),
                                      .control_group = group_.folder(),
                                      .inherited_texts = fenced.inherited_texts,
                                      .environment = std::move(environment)});
  if (!started) return NotStarted(started.error());
  child_ = std::move(*started);
  if (group_.IsEmpty()) group_ = {};
  meter_.emplace(child_->number(), options_.memory_mb);
  cpu_s_ = cpu_charged_s_ = 0;
  return {};
}

std::string WatchedProgram::Stop(int patience_ms) {
  std::string end = child_ ? child_->Finish(patience_ms) : "not running";
  child_.reset();
  group_ = {};
  return end;
}

std::string WatchedProgram::AdviceOnStartFailure() const {
  if (!options_.fence.IsUp()) return "";
  const auto unseen = FindUnseen(view_, errors_.LastLine());
  if (unseen.empty()) return "";
  std::string names;
  for (const auto& path : unseen) names += (names.empty() ? "" : " and ") + path.string();
  return fmt::format("; {} cannot be read inside its fence: give it {}", names,
                     FilesThatShow(unseen, view_, options_.by_options));
}

void WatchedProgram::Receive() { child_->Receive(kMaxReplyBytes); }

OutsideOutcome<std::string> WatchedProgram::WaitForLine(Clock::time_point deadline, double seconds) {
  Clock::time_point next_sample = Clock::now() + kSampleInterval;
  while (true) {
    if (auto line = child_->NextLine()) return std::move(*line);
    if (Clock::now() >= deadline) return tl::unexpected(TookTooLong(seconds));
    const auto patience = std::chrono::ceil<std::chrono::milliseconds>(std::min(next_sample, deadline) - Clock::now());
    std::array<pollfd, 2> watched{
        {{child_->output(), POLLIN, 0}, {child_->HasUnsent() ? child_->input() : -1, POLLOUT, 0}}};
    ::poll(watched.data(), watched.size(), std::max(0, static_cast<int>(patience.count())));
    bool over = false;
    const bool is_due = Clock::now() >= next_sample;
    if (is_due) {
      RETURN_IF_ERROR(Measure());
      next_sample = Clock::now() + kSampleInterval;
      over = child_->HasEnded() || HasClosedOutput();  // the program's child processes may keep its output open
    }
    if (over || watched[0].revents != 0 || watched[1].revents != 0) {
      over = !child_->Receive(kMaxReplyBytes) || over;
    }
    if (over && child_->PartOfLine().find('\n') == std::string_view::npos) return tl::unexpected(HowItEnded());
  }
}

/// Bubblewrap and the first process in a fence hold the output, too, so it stays open when the program has closed it.
bool WatchedProgram::HasClosedOutput() {
  if (!options_.fence.IsUp()) return false;
  const std::vector<pid_t> processes = ProcessTree(child_->number());
  const auto inside = std::span(processes).subspan(std::min(FenceProcesses(), processes.size()));
  const bool is_held = inside.empty() || std::ranges::any_of(inside, [&](pid_t process) {
                         return MayHoldPipe(process, child_->output());
                       });
  samples_closed_ = is_held ? 0 : samples_closed_ + 1;
  return samples_closed_ > 1;  // during one sample, a child may have started and its parent ended
}

OutsideOutcome<void> WatchedProgram::Rest() {
  const Clock::time_point deadline = Clock::now() + std::chrono::milliseconds(kMaxDyingMs);
  RETURN_IF_ERROR(Measure());
  const double max_cpu_s = load_.cpu_s + kMaxRestCpu_s;
  pollfd watched{child_->output(), POLLIN, 0};
  const auto is_active = [&] {
    const bool has_ended = load_.processes <= load_.ending + FenceProcesses();  // the fence's own processes end later
    return has_ended ? !child_->HasEnded() : load_.is_busy && load_.cpu_s < max_cpu_s;
  };
  while (is_active() && Clock::now() < deadline) {
    if (::poll(&watched, 1, 1) != 0) break;
    RETURN_IF_ERROR(Measure());
  }
  return {};
}

OutsideOutcome<void> WatchedProgram::ReadRest() {
  const bool is_open = child_->Receive(kMaxReplyBytes);
  if (child_->PartOfLine().find('\n') != std::string_view::npos) return {};
  if (!is_open || child_->HasEnded()) return tl::unexpected(HowItEnded());
  if (child_->PartOfLine().empty()) return {};
  return tl::unexpected(OutsideFailure{Status::kBadOutput, "wrote a part of a line: " + Printable(StartOfLine())});
}

OutsideOutcome<void> WatchedProgram::Measure() {
  last_measured_ = Clock::now();
  errors_.Trim();
  const TreeLoad load = load_ = meter_->Count();
  const ScratchUse scratch = options_.fence.MeasureScratch(child_->FirstStarted());
  // Without a control group, precise measurements are expensive. HeldMb may return an upper bound instead, as long as
  // this is at most 10 % + 4 MB above the peak so far: the reported peak has this tolerance.
  const double held_mb = group_.IsUp() ? group_.HeldMb() + scratch.names_mb
                                       : meter_->HeldMb(scratch.Mb(), std::min(options_.memory_mb, 1.1 * peak_mb_ + 4));
  cpu_s_ = std::max(cpu_s_, load.cpu_s);  // load.cpu_s is smaller if a process has ended meanwhile
  peak_mb_ = std::max(peak_mb_, held_mb);
  if (held_mb > options_.memory_mb) return TooMuchMemory();
  for (const auto& [count, limit, what] : {std::tuple{load.processes, ProgramLimits::kProcesses, "processes"},
                                           {load.threads, ProgramLimits::kThreads, "threads"},
                                           {load.descriptors, ProgramLimits::kDescriptors, "open files"},
                                           {load.pipes, ProgramLimits::Pipes(options_.fence.programs()), "pipes"},
                                           {load.sockets, ProgramLimits::kSockets, "sockets"},
                                           {load.file_locks, ProgramLimits::kFileLocks, "locks of files"}}) {
    if (count > limit) return TooMuch(fmt::format("held more than {} {}", limit, what));
  }
  return {};
}

OutsideOutcome<void> WatchedProgram::MeasureIfDue() {
  if (Clock::now() < last_measured_ + kSampleInterval) return {};
  return Measure();
}

tl::unexpected<OutsideFailure> WatchedProgram::TooMuchMemory() const {
  return TooMuch(fmt::format("held more than {:g} MB of memory", options_.memory_mb));
}

std::string WatchedProgram::StartOfLine() const {
  return WithoutFolder(std::string(child_->PartOfLine().substr(0, 1000))).substr(0, 100);
}

/// Returns the failure that says why the program will send no more lines.
OutsideFailure WatchedProgram::HowItEnded() {
  const std::string part = StartOfLine();
  if (child_->PartOfLine().size() > kMaxReplyBytes) {
    return {Status::kBadOutput,
            fmt::format("wrote a line of more than {} MiB: {}", kMaxReplyBytes >> 20, Printable(part))};
  }
  if (child_->broken_by() != 0) {
    return {Status::kFailed, fmt::format("no connection to it: {}", std::strerror(child_->broken_by())), false};
  }
  for (int i = 0; i < kMaxDyingMs && !child_->HasEnded(); ++i) ::usleep(1000);
  if (!child_->HasEnded()) return {Status::kBadOutput, "closed its output, but continued to run"};
  const std::string end = child_->Finish(0);
  if (group_.IsUp() && group_.WasFull()) return TooMuchMemory().value();
  std::string reason = "ended with " + end;
  if (!part.empty()) reason += ", in the middle of the line " + Printable(part);
  if (const std::string words = WithoutFolder(errors_.LastLine()); !words.empty()) {
    reason += "; its last words: " + Printable(words, 200);
  }
  // An exit code is the program's own decision (after an exception, for instance), but a signal may come from the
  // machine.
  return {end.starts_with("exit code") ? Status::kFailed : Status::kCrashed, std::move(reason)};
}

std::string WatchedProgram::WithoutFolder(std::string text) const {
  if (!attachment_root_) return text;
  const std::string folder = attachment_root_->path().string();
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;) {
    const std::size_t own = at + folder.size();  // below `folder`, each message has a folder of its own
    const bool is_named = own < text.size() && text[own] == '/';
    text.replace(at, folder.size() + (is_named ? 1 + AttachmentFolder::kNameLength : 0), "FILES");
  }
  return text;
}

double WatchedProgram::TakeCpuSeconds() { return cpu_s_ - std::exchange(cpu_charged_s_, cpu_s_); }

}  // namespace etude
