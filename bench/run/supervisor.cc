#include "bench/run/supervisor.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <deque>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "bench/process/child_process.h"
#include "bench/run/cell_json.h"
#include "bench/run/clock.h"
#include "bench/run/worker.h"

namespace etude {
namespace {

constexpr int kPollMilliseconds = 20;   // how stale a look at memory or at the clock may be
constexpr int kMostDeathsInSetup = 3;   // one may be chance (out of memory, a stray kill); a row of them is not
constexpr double kLongestSetupS = 600;  // clips are read in it
constexpr double kGraceS = 10;          // a method outside is ended by the worker, which then still has to tell
constexpr int kShutdownGraceMs = 3000;  // in which a worker lets its methods outside come to their end

Clock::time_point After(double seconds) {
  constexpr double kLongest = 1e9;  // beyond any run, within what the clock can hold
  return Clock::now() +
         std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(std::min(seconds, kLongest)));
}

/// A child and what it is at.
struct Worker {
  Worker(ChildProcess child, Clock::time_point setup_deadline) : process(std::move(child)), deadline(setup_deadline) {}

  ChildProcess process;
  Clock::time_point deadline;  ///< of what it is at
  bool ready = false;          ///< its set-up is done
  std::optional<Order> order;  ///< the one it works on: methods not yet answered
  bool built = false;          ///< the order's world is
  bool dismissed = false;      ///< it ended, and no other takes its place
};

class Supervisor {
 public:
  Supervisor(const Plan& plan, std::vector<Order> orders, const SupervisorOptions& options, const Deliver& deliver)
      : plan_(plan), orders_(orders.begin(), orders.end()), options_(options), deliver_(deliver) {}

  Result<bool> Run(const SuiteSetup& setup) {
    ASSIGN_OR_RETURN(const auto setup_line,
                     WriteJson({{"setup", EncodeSetup(setup)}, {"error_folder", options_.error_folder}}));
    setup_line_ = setup_line;
    const std::size_t jobs = std::min<std::size_t>(WorkerCount(options_.jobs), orders_.size());
    while (workers_.size() < jobs) {
      auto worker = StartWorker();
      if (!worker && !workers_.empty()) break;  // fewer do the same work
      if (!worker) return tl::unexpected(worker.error());
      workers_.push_back(std::move(*worker));
    }
    while (!workers_.empty()) {
      if (options_.stop != nullptr && *options_.stop) return false;
      RETURN_IF_ERROR(Step());
    }
    return true;
  }

 private:
  Result<Worker> StartWorker() {
    ASSIGN_OR_RETURN(auto process,
                     ChildProcess::Start({.program = options_.program, .arguments = {"worker"}, .error_file = ""}));
    process.Send(setup_line_);  // a worker that is already dead is noticed when it is polled
    return Worker(std::move(process), After(kLongestSetupS));
  }

  const Limits& LimitsOf(const Order& order) const { return plan_.scenario_of(order.world).scenario().limits; }

  /// The next order, or the end of its work.
  void HandOut(Worker& worker) {
    worker.order.reset();
    worker.built = false;
    if (orders_.empty()) {
      worker.process.Finish(kShutdownGraceMs);
      worker.dismissed = true;
      return;
    }
    worker.order = std::move(orders_.front());
    orders_.pop_front();
    const World& world = plan_.world(worker.order->world);
    Json order{{"world", {world.scenario, world.condition, world.trial}}, {"methods", worker.order->methods}};
    worker.process.Send(order.dump());
    worker.deadline = After(LimitsOf(*worker.order).time_s);
  }

  /// The clock starts for the first method that is not answered yet.
  void StartNextMethod(Worker& worker) {
    if (worker.order->methods.empty()) return HandOut(worker);
    const auto& methods = plan_.scenario_of(worker.order->world).scenario().methods;
    const MethodEntry& method = methods[worker.order->methods.front()];
    const double limit_s = LimitsOf(*worker.order).time_s;
    const double ask_s = method.exec.empty() ? 0 : LongestAskSeconds(method.time_s.value_or(limit_s)) + kGraceS;
    worker.deadline = After(ask_s + (method.RunsInTask() ? limit_s : 0));
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
    // With no orders left, idle workers are dropped, also those still in their set-up.
    std::erase_if(workers_,
                  [&](const Worker& worker) { return worker.dismissed || (orders_.empty() && !worker.order); });
    return {};
  }

  Result<void> WatchOver(Worker& worker, bool has_input) {
    if (has_input) {
      const bool alive = worker.process.Receive();
      for (auto line = worker.process.NextLine(); line && !worker.dismissed; line = worker.process.NextLine()) {
        ASSIGN_OR_RETURN(auto taken, Take(worker, *line));
        if (!taken) return Replace(worker, Status::kBadOutput, "its worker answered with something else");
      }
      if (worker.dismissed) return {};
      if (!alive) return Replace(worker, Status::kCrashed, "its worker ended with " + worker.process.Finish());
    }
    if (Clock::now() > worker.deadline) {
      const double limit = worker.order ? LimitsOf(*worker.order).time_s : kLongestSetupS;
      return Replace(worker, Status::kTimeout, fmt::format("took longer than {:g} s", limit));
    }
    if (worker.order) {
      const double limit = LimitsOf(*worker.order).memory_mb;
      const double resident = worker.process.MeasureAlone().resident_mb;  // it watches methods outside itself
      if (resident > limit) {
        return Replace(worker, Status::kOutOfMemory, fmt::format("held more than {:g} MB of memory", limit));
      }
    }
    return {};
  }

  /// False when a worker said something that it should not.
  Result<bool> Take(Worker& worker, const std::string& line) {
    if (!worker.ready) {
      if (line != kWorkerReady) return false;
      worker.ready = true;
      deaths_in_setup_ = 0;
      HandOut(worker);
      return true;
    }
    if (!worker.built) {
      worker.built = worker.order && line == kWorldBuilt;
      if (worker.built) StartNextMethod(worker);
      return worker.built;
    }
    const Place place{"a worker's answer", 0, 0};
    const auto json = ReadJson(line, place.file);
    auto finished = json ? DecodeFinishedCell(*json, place) : tl::unexpected(json.error());
    const std::size_t cell = plan_.CellAt(worker.order->world, worker.order->methods.front());
    if (!finished || finished->row.Id() != plan_.IdentityOf(cell).Id()) return false;
    worker.order->methods.erase(worker.order->methods.begin());
    StartNextMethod(worker);
    RETURN_IF_ERROR(deliver_(cell, std::move(*finished)));
    return true;
  }

  /// Ends a worker, makes rows of what it was at, and starts another while there is work.
  Result<void> Replace(Worker& worker, Status status, const std::string& reason) {
    worker.process.Finish();
    if (!worker.ready && ++deaths_in_setup_ == kMostDeathsInSetup) {
      return Fail({}, "{} workers in a row failed in their set-up: {}", kMostDeathsInSetup, reason);
    }
    if (worker.order) {
      RETURN_IF_ERROR(GiveUp(*worker.order, worker.built, status, reason));
    }
    if (orders_.empty()) {
      worker.dismissed = true;
      return {};
    }
    ASSIGN_OR_RETURN(auto next, StartWorker());
    worker = std::move(next);
    return {};
  }

  /// Delivers the cell in progress as lost (every cell, while the world was being built), and orders the rest anew.
  Result<void> GiveUp(Order order, bool built, Status status, const std::string& reason) {
    const World& world = plan_.world(order.world);
    const std::size_t lost = built ? 1 : order.methods.size();
    for (std::size_t i = 0; i < lost; ++i) {
      const std::size_t method = order.methods[i];
      const std::string when = built ? reason : reason + " while its world was being built";
      FinishedCell cell{plan_.scenario_of(order.world).EndedRow(world.condition, world.trial, method, status, when),
                        {}};
      RETURN_IF_ERROR(deliver_(plan_.CellAt(order.world, method), std::move(cell)));
    }
    order.methods.erase(order.methods.begin(), order.methods.begin() + static_cast<std::ptrdiff_t>(lost));
    if (!order.methods.empty()) orders_.push_front(std::move(order));
    return {};
  }

  const Plan& plan_;
  std::deque<Order> orders_;
  const SupervisorOptions& options_;
  const Deliver& deliver_;
  std::string setup_line_;
  std::vector<Worker> workers_;
  int deaths_in_setup_ = 0;  ///< since a worker last became ready
};

}  // namespace

Result<bool> RunOrders(const SuiteSetup& setup, const Plan& plan, std::vector<Order> orders,
                       const SupervisorOptions& options, const Deliver& deliver) {
  if (orders.empty()) return true;
  return Supervisor(plan, std::move(orders), options, deliver).Run(setup);
}

int WorkerCount(int jobs) {
  return jobs > 0 ? jobs : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

std::string ThisProgram() { return std::filesystem::read_symlink("/proc/self/exe").string(); }

}  // namespace etude
