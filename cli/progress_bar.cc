#include "cli/progress_bar.h"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "cli/interrupt.h"

namespace etude {
namespace {

constexpr int kBarWidth = 32;

std::string ToGo(double seconds) { return seconds < 0.5 ? "" : fmt::format(", about {:.0f} s to go", seconds); }

/// Estimates the time that the amount `left` will take if the amount `done` took `seconds`.
std::string Remaining(double done, double left, double seconds) { return done <= 0 ? "" : ToGo(seconds / done * left); }

/// Prints without throwing if standard error is closed. fmt::print would throw, and the exception would end a run.
void Print(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

ProgressBar::ProgressBar(Begins begins) : is_terminal_(::isatty(STDERR_FILENO) == 1), begins_(begins) {}

bool ProgressBar::IsTooSoon(double share) const {
  if (begins_ == Begins::kAtOnce || is_shown_) return false;
  constexpr double kSoonS = 0.3, kLongS = 1.5;
  return share >= 1 || SecondsSince(began_) < (is_terminal_ ? kSoonS : kLongS);
}

void ProgressBar::Show(const Progress& progress) {
  if (progress.written) {
    if (!is_writing_) *this = ProgressBar(Begins::kWhenItTakesLong);  // a second bar shows the writing of results
    is_writing_ = true;
    const double share = *progress.written;
    return Show(share, "results summarised", Remaining(share, 1 - share, SecondsSince(began_)));
  }
  const std::string answered =
      progress.cells_answered == 0 ? "" : fmt::format("{} left to measure, ", progress.cells_answered);
  Show(progress.cells_done >= progress.cells ? 1 : progress.work_done / progress.work,
       fmt::format("{}/{} cells, {} ok, {}{:.0f} s", progress.cells_done, progress.cells, progress.cells_ok, answered,
                   progress.seconds),
       ToGo(progress.SecondsToGo()));
}

void ProgressBar::Show(double share, const std::string& what, const std::string& remaining) {
  if (IsTooSoon(share)) return;
  is_shown_ = true;
  if (is_terminal_) {
    const int filled = static_cast<int>(share * kBarWidth);
    const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
    Print(fmt::format("\r\033[K[{}] {}{}{}", bar, what, remaining, share >= 1 ? "\n" : ""));
    return;
  }
  const int tenths = static_cast<int>(share * 10);
  const bool is_due = SecondsSince(began_) >= next_s_;
  if (tenths <= tenths_shown_ && !is_due) return;
  if (is_due) {
    constexpr double kMaxPauseS = 60;
    next_s_ = SecondsSince(began_) + pause_s_;
    pause_s_ = std::min(2 * pause_s_, kMaxPauseS);
  }
  tenths_shown_ = tenths;
  Print(fmt::format("{:3d} %  {}{}\n", static_cast<int>(share * 100), what, remaining));
}

OnProgress ProgressOf(std::string what) {
  return [=, bar = ProgressBar(ProgressBar::Begins::kWhenItTakesLong), began = Clock::now()](std::size_t done,
                                                                                             std::size_t all) mutable {
    bar.Show(all == 0 ? 1 : static_cast<double>(done) / static_cast<double>(all),
             fmt::format("{}/{} {}", done, all, what),
             Remaining(static_cast<double>(done), static_cast<double>(all - done), SecondsSince(began)));
  };
}

FilmWatch WatchFilms(const Interrupt& interrupt, int jobs) {
  const auto tell = [of = std::string(), tell = OnProgress()](const std::string& file, std::size_t done,
                                                              std::size_t frames) mutable {
    if (file != of) tell = ProgressOf("frames of " + file);
    of = file;
    tell(done, frames);
  };
  return {.progress = tell, .stop = interrupt.requested(), .jobs = jobs};
}

Listener TerminalListener() {
  Listener listener;
  listener.print = [](const std::string& text) { fmt::print("{}", text); };
  listener.progress = [](std::string what) { return ProgressOf(std::move(what)); };
  listener.film = [](const std::function<Result<bool>(const FilmWatch& watch)>& write) {
    const Interrupt interrupt;
    return UnlessInterrupted(write(WatchFilms(interrupt)), interrupt);
  };
  return listener;
}

}  // namespace etude
