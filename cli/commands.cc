#include "cli/commands.h"

#include <fmt/core.h>

#include <algorithm>
#include <cstdio>

#include "bench/gate/baseline_file.h"
#include "bench/model/run_data.h"
#include "engine/base/machine.h"
#include "engine/base/utf8.h"

namespace etude {

int Complain(const Error& error) {
  std::fputs(("etude: " + ToString(error) + "\n").c_str(), stderr);
  return IsOfThisMachine(error) ? kIncompleteRun : kUnusableInput;
}

int Finish(const Result<int>& code) { return code ? *code : Complain(code.error()); }

int TellStopped(const Error& what_is_left) {
  Complain(what_is_left);
  return kInterrupted;
}

Result<int> UnlessReplaced(const std::string& folder, const RunData& run, int code) {
  if (CheckStillThere(folder, run)) return code;
  Complain({{folder, 0, 0},
            "changed while Etude wrote files into it: another run replaced the folder, or another program wrote a file "
            "there. Repeat this command"});
  return kIncompleteRun;
}

void TellUnsealed(const std::string& why) {
  if (!why.empty()) std::fputs(("etude: read unsealed: " + Visible(why) + "\n").c_str(), stderr);
}

Result<Snapshot> TakeBaseline(const std::string& path, Sealing sealing) {
  ASSIGN_OR_RETURN(auto baseline, LoadBaseline(path, sealing == Sealing::kIgnored ? BaselineSeal::kMayBreak
                                                                                  : BaselineSeal::kMustHold));
  TellUnsealed(baseline.unsealed);
  return baseline;
}

std::size_t CountCharacters(std::string_view text) {
  return static_cast<std::size_t>(std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string CountOf(std::size_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::vector<std::string> FirstLines(std::vector<std::string> lines, std::size_t most, std::string_view rest) {
  const std::size_t count = lines.size();
  if (count <= most) return lines;
  lines.resize(most);
  lines.push_back(fmt::format("and {} {}", count - most, rest));
  return lines;
}

void PrintList(const std::string& title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  fmt::print("{}\n", title);
  for (const std::string& line : lines) fmt::print("  {}\n", line);
}

}  // namespace etude
