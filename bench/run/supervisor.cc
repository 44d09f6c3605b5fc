#include "bench/run/supervisor.h"

#include <fmt/ranges.h>
#include <poll.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "bench/run/outside_programs.h"
#include "bench/run/worker.h"
#include "engine/base/machine.h"
#include "io/process/child_process.h"
#include "io/process/clock.h"

namespace etude {
namespace {

constexpr int kPollMilliseconds = 20;  // pause between two measurements of workers' memory and time
constexpr double kAheadS = 0.05;       // seconds of work that a worker gets at a time, estimated from earlier worlds
// Worlds that take more seconds than this are begun early (OrderQueue). If one were begun last, all other workers would
// wait for it, which costs more time than to prepare its condition in several workers.
constexpr double kLongWorldS = 1;
constexpr int kGatherMicroseconds = 2000;  // pause to collect more results if no worker is idle
// Number of successive worker deaths in set-up that end the run. A single death may have a passing cause, such as too
// little free memory.
constexpr int kMaxDeathsInSetup = 3;
constexpr double kMaxSetupS = 600;      // maximum duration of a worker's set-up, in which the worker loads clips
constexpr double kClockPerLimit = 20;   // wall-time limit of a world or method, a multiple of the processor-time limit
constexpr double kGraceS = 10;          // additional time in which a worker can end an outside method and report this
constexpr int kShutdownGraceMs = 3000;  // time in which an ending worker can end all its outside methods

Clock::time_point After(double seconds) {
  constexpr double kMaxSeconds = 1e9;  // longer than any run, but short enough for Clock::time_point
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, kMaxSeconds)));
}

/// A worker process, and what it is doing: its set-up, building a world, or running a method.
struct Worker {
  Worker(ChildProcess child, Clock::time_point setup_deadline) : process(std::move(child)), deadline(setup_deadline) {}

  ChildProcess process;
  Clock::time_point deadline;  ///< latest end of the worker's present step; if it is missed, this machine was too slow
  double cpu_s = 0;            ///< processor time of the worker at the last measurement
  double cpu_began = 0;        ///< processor time of the worker when it began its present step
  bool ready = false;          ///< true: the worker has finished its set-up
  /// The worker's orders (pieces of work); the first one is in progress and lists the methods that have no answer yet.
  std::deque<Order> orders;
  bool built = false;               ///< true: the worker has built the world of its first order
  bool dismissed = false;           ///< true: the worker has ended and is not replaced
  Clock::time_point began = {};     ///< when the worker began its first order's world
  Clock::time_point measured = {};  ///< when memory and time were measured last
  std::size_t condition = OrderQueue::kNowhere;
};

/// The wall time of the worlds of a scenario that have been run so far, and their number.
struct Pace {
  double seconds = 0;
  int worlds = 0;
  std::optional<double> SecondsPerWorld() const { return worlds == 0 ? std::nullopt : std::optional(seconds / worlds); }
};

class Supervisor {
 public:
  /// If `answered` is null, workers run the methods that `orders` list. Otherwise they measure the cells in `answered`.
  Supervisor(const Plan& plan, std::vector<Order> orders, CellTable* answered, const SupervisorOptions& options,
             const Deliver& deliver)
      : plan_(plan),
        answered_(answered),
        orders_(plan, std::move(orders),
                [this](int scenario) { return PaceOf(scenario).SecondsPerWorld().value_or(0) > kLongWorldS; }),
        options_(options),
        deliver_(deliver),
        paces_(plan.scenarios().size()) {}

  Result<bool> Run(const SuiteSetup& setup) {
    AdoptOrphans();  // if a worker is killed, its outside methods become children of this process, which can end them
    const std::size_t jobs = std::min<std::size_t>(WorkerCount(options_.jobs), orders_.size());
    std::size_t programs = 1;  // the maximum number of programs that one worker runs at the same time
    for (const PreparedScenario& scenario : plan_.scenarios())
      programs = std::max(programs, ProgramsIn(scenario.scenario()).size());
    Fence fence = options_.fence;
    fence.ShareBy(static_cast<int>(std::max<std::size_t>(jobs, 1) * programs));
    ASSIGN_OR_RETURN(const auto setup_line, WriteJson({{"setup", EncodeSetup(setup)},
                                                       {"error_folder", options_.error_folder},
                                                       {"fence", EncodeFence(fence)},
                                                       {"key", setup.seed.IsPlain() ? "" : Hex(setup.seed.key())}}));
    setup_line_ = setup_line;
    while (workers_.size() < jobs) {
      auto worker = StartWorker();
      if (!worker && !workers_.empty()) break;  // the run continues with fewer workers
      if (!worker) return tl::unexpected(worker.error());
      workers_.push_back(std::move(*worker));
    }
    while (!workers_.empty()) {
      if (options_.stop != nullptr && *options_.stop) return false;
      RETURN_IF_ERROR(Step());
      if (options_.on_wait) options_.on_wait();
    }
    if (not_run_ == 0) return true;
    return FailOfMachine("{}; cells not run: {}", why_not_run_, not_run_);
  }

 private:
  Result<Worker> StartWorker() {
    ASSIGN_OR_RETURN(auto process,
                     ChildProcess::Start({.program = options_.program, .arguments = {"worker"}, .error_file = ""}));
    process.Send(setup_line_);  // if the worker is dead, this is noticed when it is polled
    return Worker(std::move(process), After(kMaxSetupS));
  }

  const Limits& LimitsOf(const Order& order) const { return plan_.scenario_of(order.world).scenario().limits; }

  /// Gives more orders to a worker. If no orders are left, ends the worker.
  Result<void> HandOut(Worker& worker) {
    double ahead_s = 0;
    for (const Order& order : worker.orders) ahead_s += PaceOf(order).SecondsPerWorld().value_or(kAheadS);
    std::string lines;
    while (!orders_.empty() && (worker.orders.empty() || ahead_s < kAheadS)) {
      const Order& next = worker.orders.emplace_back(orders_.Take(worker.condition));
      if (!lines.empty()) lines += '\n';
      RETURN_IF_ERROR(AddText(next, lines));
      ahead_s += PaceOf(next).SecondsPerWorld().value_or(kAheadS);
      if (worker.orders.size() == 1) RETURN_IF_ERROR(BeginWorld(worker));
    }
    if (!lines.empty()) worker.process.Send(lines);
    if (!worker.orders.empty()) return {};
    worker.process.Finish(kShutdownGraceMs);
    worker.dismissed = true;
    return {};
  }

  /// Appends an order's lines for the worker to `text`: one for the world; or, if workers measure, one for each cell.
  Result<void> AddText(const Order& order, std::string& text) {
    const World& world = plan_.world(order.world);
    if (answered_ == nullptr) {
      fmt::format_to(std::back_inserter(text), R"({{"world":[{},{},{}],"first_cell":{},"methods":[{}]}})",
                     world.scenario, world.condition, world.trial, plan_.CellAt(order.world, 0),
                     fmt::join(order.methods, ","));
      return {};
    }
    for (std::size_t i = 0; i < order.methods.size(); ++i) {
      ASSIGN_OR_RETURN(const auto line, answered_->ReadLine(plan_.CellAt(order.world, order.methods[i])));
      if (i > 0) text += '\n';
      text += line;
    }
    return {};
  }

  Pace& PaceOf(int scenario) { return paces_[static_cast<std::size_t>(scenario)]; }
  Pace& PaceOf(const Order& order) { return PaceOf(plan_.world(order.world).scenario); }

  static ProcessUsage Measure(Worker& worker) {
    worker.measured = Clock::now();
    // MeasureAlone leaves out the outside methods, because the worker itself measures them.
    const ProcessUsage usage = worker.process.MeasureAlone();
    worker.cpu_s = usage.own_cpu_s;
    return usage;
  }

  /// Starts the time limits of the worker's next step; the step's wall time may be at most `clock_s` seconds.
  static void Begin(Worker& worker, double clock_s) {
    constexpr auto kStale = std::chrono::milliseconds(100);
    if (Clock::now() - worker.measured > kStale) Measure(worker);
    worker.cpu_began = worker.cpu_s;
    worker.deadline = After(clock_s);
  }

  /// Begins the first of a worker's orders. If cells are only measured, the worker builds no world.
  Result<void> BeginWorld(Worker& worker) {
    worker.built = answered_ != nullptr;
    worker.began = Clock::now();
    Begin(worker, kClockPerLimit * LimitsOf(worker.orders.front()).time_s);
    return worker.built ? StartNextMethod(worker) : Result<void>();
  }

  Result<void> EndWorld(Worker& worker) {
    Pace& pace = PaceOf(worker.orders.front());
    pace.seconds += SecondsSince(worker.began);
    ++pace.worlds;
    worker.orders.pop_front();
    return worker.orders.empty() ? HandOut(worker) : BeginWorld(worker);
  }

  /// Starts the time limits of the order's next method. If no method is left, ends the world.
  Result<void> StartNextMethod(Worker& worker) {
    const Order& order = worker.orders.front();
    if (order.methods.empty()) return EndWorld(worker);
    const auto& methods = plan_.scenario_of(order.world).scenario().methods;
    const MethodEntry& method = methods[order.methods.front()];
    const double limit_s = LimitsOf(order).time_s;
    const auto longest_ask_s = [&](const MethodEntry& program) {
      return MaxAskSeconds(program.time_s.value_or(limit_s)) + kGraceS;
    };
    double seconds = method.RunsInTask() ? kClockPerLimit * limit_s : 0;
    if (!method.exec.empty()) seconds += longest_ask_s(method);
    if (answered_ != nullptr) {
      seconds = 0;
      for (const OutsideMetric& metric : plan_.scenario_of(order.world).scenario().outside_metrics) {
        seconds += longest_ask_s(metric.program);
      }
    }
    Begin(worker, seconds);
    return {};
  }

  Result<void> Step() {
    std::vector<pollfd> watched;
    for (const Worker& worker : workers_) {
      watched.push_back({worker.process.output(), POLLIN, 0});
      watched.push_back({worker.process.HasUnsent() ? worker.process.input() : -1, POLLOUT, 0});
    }
    ::poll(watched.data(), watched.size(), kPollMilliseconds);
    for (std::size_t i = 0; i < workers_.size(); ++i) {
      const bool has_input = watched[2 * i].revents != 0 || watched[2 * i + 1].revents != 0;
      RETURN_IF_ERROR(WatchOver(workers_[i], has_input));
    }
    // If no orders are left, end the idle workers, including those still in their set-up.
    std::erase_if(workers_,
                  [&](const Worker& worker) { return worker.dismissed || (orders_.empty() && worker.orders.empty()); });
    const bool nobody_waits =
        std::ranges::all_of(workers_, [](const auto& worker) { return worker.orders.size() > 1; });
    if (nobody_waits && !workers_.empty()) ::usleep(kGatherMicroseconds);
    return {};
  }

  Result<void> WatchOver(Worker& worker, bool has_input) {
    if (worker.process.broken_by() != 0) return ReplaceEnded(worker);  // the worker may not have received its orders
    // Handle the lines that the worker wrote and, if the worker has ended, its end.
    if (has_input) {
      const bool alive = worker.process.Receive();
      for (auto line = worker.process.NextLine(); line && !worker.dismissed; line = worker.process.NextLine()) {
        ASSIGN_OR_RETURN(auto taken, Take(worker, *line));
        if (!taken) return Replace(worker, Status::kBadOutput, "its worker sent an unexpected answer");
      }
      if (worker.dismissed) return {};
      if (!alive) return ReplaceEnded(worker);
      if (worker.ready) RETURN_IF_ERROR(HandOut(worker));  // give it further orders
    }
    // Enforce the limits of wall time, memory and processor time.
    const auto now = Clock::now();
    if (now > worker.deadline) {
      Measure(worker);
      return Replace(worker, {},
                     fmt::format("a worker reached its limit of wall-clock time after {:.1f} s of processor time",
                                 worker.cpu_s - worker.cpu_began));
    }
    if (!worker.orders.empty() && now - worker.measured >= std::chrono::milliseconds(kPollMilliseconds)) {
      const Limits& limits = LimitsOf(worker.orders.front());
      const ProcessUsage usage = Measure(worker);
      if (usage.resident_mb > limits.memory_mb) {
        return Replace(worker, Status::kOutOfMemory, fmt::format("held more than {:g} MB of memory", limits.memory_mb));
      }
      if (worker.cpu_s - worker.cpu_began > limits.time_s) {
        return Replace(worker, Status::kTimeout,
                       fmt::format("took longer than {:g} s of processor time", limits.time_s));
      }
    }
    return {};
  }

  void CountNotRun(std::size_t cells, const std::string& why) {
    const std::string prefix = ToString(FailOfMachine("").value());  // this prefix is added again later
    if (not_run_ == 0) why_not_run_ = why.starts_with(prefix) ? why.substr(prefix.size()) : why;
    not_run_ += cells;
  }

  /// Handles one line that a worker wrote. Returns false if the line was not expected.
  Result<bool> Take(Worker& worker, const std::string& line) {
    // The line says that the set-up is done.
    if (!worker.ready) {
      if (line != kWorkerReady) return false;
      worker.ready = true;
      deaths_in_setup_ = 0;
      RETURN_IF_ERROR(HandOut(worker));
      return true;
    }
    if (worker.orders.empty()) return false;
    // The line says that the world is built.
    if (!worker.built) {
      worker.built = line == kWorldBuilt;
      if (worker.built) RETURN_IF_ERROR(StartNextMethod(worker));
      return worker.built;
    }
    // The line says that a cell was not run.
    Order& order = worker.orders.front();
    if (line.starts_with(kNotRun)) {
      CountNotRun(1, line.substr(std::string_view(kNotRun).size()));
      order.methods.erase(order.methods.begin());
      RETURN_IF_ERROR(StartNextMethod(worker));
      return true;
    }
    // The line contains a finished or answered cell.
    const auto head = ReadCellLineHead(line);
    if (!head || head->cell != plan_.CellAt(order.world, order.methods.front())) return false;
    const bool may_be_unmeasured =
        answered_ == nullptr && !plan_.scenario_of(order.world).scenario().outside_metrics.empty();
    if (!head->is_measured && !may_be_unmeasured) return false;
    order.methods.erase(order.methods.begin());
    RETURN_IF_ERROR(StartNextMethod(worker));
    RETURN_IF_ERROR(deliver_({*head, line}));
    return true;
  }

  /// Replaces a worker that ended by itself or whose pipes are broken.
  Result<void> ReplaceEnded(Worker& worker) {
    if (const int reason = worker.process.broken_by(); reason != 0) {
      return Replace(worker, {}, fmt::format("no connection to a worker: {}", std::strerror(reason)));
    }
    const std::string end = worker.process.Finish();
    const int code = worker.process.exit_code();
    if (code == kCannotGoOn) return Replace(worker, {}, "a worker could not continue");
    if (code == 128 + SIGXCPU) return Replace(worker, {}, "a worker reached the limit of processor time (ulimit -t)");
    return Replace(worker, Status::kCrashed, "its worker ended with " + end);
  }

  /// Ends a worker, reports its work in progress as lost, and starts another worker if orders are left. If `status` is
  /// nullopt, this machine is the cause, and the lost cells get no rows.
  Result<void> Replace(Worker& worker, std::optional<Status> status, const std::string& reason) {
    worker.process.Finish();
    if (!worker.ready && ++deaths_in_setup_ == kMaxDeathsInSetup) {
      return FailOfMachine("{} workers in a row failed before they were ready: {}", kMaxDeathsInSetup, reason);
    }
    if (!worker.orders.empty()) {
      Order order = std::move(worker.orders.front());
      worker.orders.pop_front();
      for (; !worker.orders.empty(); worker.orders.pop_back()) {  // puts back the orders that were not begun
        orders_.PutBack(std::move(worker.orders.back()));
      }
      RETURN_IF_ERROR(GiveUp(std::move(order), worker.built, status, reason));
    }
    if (orders_.empty()) {
      worker.dismissed = true;
      return {};
    }
    ASSIGN_OR_RETURN(auto next, StartWorker());
    next.condition = worker.condition;
    worker = std::move(next);
    return {};
  }

  /// Delivers the cell in progress as lost, or all cells of the world if it was still being built. The other methods
  /// that `order` lists return to the queue. If `status` is nullopt, the lost cells get no rows and are only counted.
  Result<void> GiveUp(Order order, bool built, std::optional<Status> status, const std::string& reason) {
    const World& world = plan_.world(order.world);
    const std::size_t lost = built ? 1 : order.methods.size();
    if (!status) CountNotRun(lost, reason);
    for (std::size_t i = 0; status && i < lost; ++i) {
      const std::size_t method = order.methods[i];
      const std::string when = built ? reason : reason + " while its world was being built";
      const std::size_t cell = plan_.CellAt(order.world, method);
      const std::string line = EncodeCellLine(
          cell, {plan_.scenario_of(order.world).EndedRow(world.condition, world.trial, method, *status, when), {}});
      RETURN_IF_ERROR(deliver_({{cell, *status}, line}));
    }
    order.methods.erase(order.methods.begin(), order.methods.begin() + static_cast<std::ptrdiff_t>(lost));
    if (!order.methods.empty()) orders_.PutBack(std::move(order));
    return {};
  }

  const Plan& plan_;
  CellTable* const answered_;  ///< the answered cells that workers measure; null if workers run methods
  OrderQueue orders_;
  const SupervisorOptions& options_;
  const Deliver& deliver_;
  std::string setup_line_;
  std::vector<Worker> workers_;
  std::vector<Pace> paces_;  ///< wall time of the worlds so far, by scenario
  int deaths_in_setup_ = 0;  ///< number of workers that died during set-up since a worker last finished its set-up
  std::size_t not_run_ = 0;  ///< number of cells that could not be run
  std::string why_not_run_;  ///< why a cell could not be run; the reason of the first such cell
};

/// Returns the orders, each reduced to its answered cells or, if not `are_answered`, to its other cells.
std::vector<Order> OrdersOf(const Plan& plan, const std::vector<Order>& orders, const CellTable& answered,
                            bool are_answered) {
  std::vector<Order> found;
  for (Order order : orders) {
    std::erase_if(order.methods,
                  [&](std::size_t method) { return answered.Has(plan.CellAt(order.world, method)) != are_answered; });
    if (!order.methods.empty()) found.push_back(std::move(order));
  }
  return found;
}

/// Runs all methods, and then measures the answered cells.
Result<bool> RunAndMeasure(const SuiteSetup& setup, const Plan& plan, const std::vector<Order>& orders,
                           const SupervisorOptions& options, const Deliver& deliver) {
  CellTable& answered = *options.answered;
  for (CellTable* const measured : {static_cast<CellTable*>(nullptr), &answered}) {
    std::vector<Order> of_phase = OrdersOf(plan, orders, answered, measured != nullptr);
    if (measured != nullptr && options.on_all_answered) RETURN_IF_ERROR(options.on_all_answered());
    if (of_phase.empty()) continue;
    ASSIGN_OR_RETURN(const bool whole, Supervisor(plan, std::move(of_phase), measured, options, deliver).Run(setup));
    if (!whole) return false;
  }
  return true;
}

}  // namespace

Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver) {
  if (orders.empty()) return true;
  if (!HasOutsideMetrics(plan)) return Supervisor(plan, std::move(orders), nullptr, options, deliver).Run(setup);
  if (options.answered != nullptr) return RunAndMeasure(setup, plan, orders, options, deliver);
  TemporaryLines lines(plan.cell_count());
  SupervisorOptions keeping = options;
  keeping.answered = &lines.cells();
  return RunAndMeasure(setup, plan, orders, keeping, [&](const DeliveredCell& cell) {
    return cell.head.is_measured ? deliver(cell) : lines.Add(cell.head.cell, cell.line);
  });
}

bool HasOutsideMetrics(const Plan& plan) {
  return std::ranges::any_of(plan.scenarios(), [](const auto& one) { return !one.scenario().outside_metrics.empty(); });
}

Result<FinishedCell> DeliveredCell::Read(const Plan& plan) const {
  return DecodeCellLine(line, plan.IdentityOf(head.cell), {"a worker's answer", 0, 0});
}

int WorkerCount(int jobs) {
  return jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

}  // namespace etude
