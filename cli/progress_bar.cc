#include "cli/progress_bar.h"

#include <fmt/core.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace etude {
namespace {

constexpr int kWidth = 32;

std::string Remaining(const Progress& progress) {
  if (progress.worlds_done == 0 || progress.worlds_done == progress.worlds) return "";
  const double each = progress.seconds / static_cast<double>(progress.worlds_done);
  return fmt::format(", about {:.0f} s to go", each * static_cast<double>(progress.worlds - progress.worlds_done));
}

/// fmt::print throws when nobody listens any more; that must not end a run.
void Print(const std::string& text) { std::fputs(text.c_str(), stderr); }

}  // namespace

ProgressBar::ProgressBar() : is_terminal_(::isatty(STDERR_FILENO) == 1) {}

void ProgressBar::Show(const Progress& progress) {
  const double share =
      progress.worlds == 0 ? 1 : static_cast<double>(progress.worlds_done) / static_cast<double>(progress.worlds);
  const std::string text = fmt::format("{}/{} worlds, {}/{} cells ok, {:.0f} s", progress.worlds_done, progress.worlds,
                                       progress.cells_ok, progress.cells_done, progress.seconds);
  if (is_terminal_) {
    const int filled = static_cast<int>(share * kWidth);
    const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '.');
    const std::string_view end = progress.worlds_done == progress.worlds ? "\n" : "";
    Print(fmt::format("\r\033[K[{}] {}{}{}", bar, text, Remaining(progress), end));
  } else if (const int tenths = static_cast<int>(share * 10); tenths > tenths_shown_) {
    tenths_shown_ = tenths;
    Print(fmt::format("{:3d} %  {}\n", tenths * 10, text));
  }
}

}  // namespace etude
