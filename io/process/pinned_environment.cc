#include "io/process/pinned_environment.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <span>
#include <string_view>

#include "engine/base/machine.h"

namespace etude {
namespace {

/// The variable that marks a restarted process; it holds the process ID, which exec keeps.
constexpr std::string_view kRestarted = "ETUDE_RESTARTED";

std::string_view NameOf(std::string_view assignment) { return assignment.substr(0, assignment.find('=')); }

template <typename Texts>
bool Holds(const Texts& texts, std::string_view text) {
  return std::ranges::find(texts, text) != texts.end();
}

/// Returns true if the environment equals ClosedEnvironment; the environment may also contain the key of secret worlds.
bool IsClosed() {
  std::size_t pinned = 0;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (Holds(PinnedEnvironment(), *entry)) {
      ++pinned;
    } else if (!Holds(PassedVariables(), NameOf(*entry)) && NameOf(*entry) != kKeyVariable) {
      return false;
    }
  }
  return pinned == PinnedEnvironment().size();
}

using Libraries = std::vector<std::pair<std::string, std::string>>;

/// Finds the build ID in the notes of an ELF segment; "" if there is none.
std::string BuildIdIn(std::span<const unsigned char> notes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  while (notes.size() >= sizeof(ElfW(Nhdr))) {
    ElfW(Nhdr) head;
    std::memcpy(&head, notes.data(), sizeof head);
    const std::size_t name = sizeof head, value = name + padded(head.n_namesz), end = value + padded(head.n_descsz);
    if (end > notes.size()) break;
    if (head.n_type == NT_GNU_BUILD_ID && head.n_namesz == 4 && std::memcmp(notes.data() + name, "GNU", 4) == 0) {
      return fmt::format("{:02x}", fmt::join(notes.subspan(value, head.n_descsz), ""));
    }
    notes = notes.subspan(end);
  }
  return "";
}

int AddLibrary(dl_phdr_info* object, std::size_t, void* list) {
  const std::string name = std::filesystem::path(object->dlpi_name).filename().string();
  // Skip the program itself, its modules and the kernel's vDSO.
  if (name.empty() || name.starts_with("etude_") || name.starts_with("linux-vdso")) return 0;
  std::string build;
  for (const ElfW(Phdr) & part : std::span(object->dlpi_phdr, object->dlpi_phnum)) {
    if (part.p_type != PT_NOTE || !build.empty()) continue;
    // NOLINTNEXTLINE(performance-no-int-to-ptr): the loader gives addresses as numbers
    build = BuildIdIn({reinterpret_cast<const unsigned char*>(object->dlpi_addr + part.p_vaddr), part.p_memsz});
  }
  static_cast<Libraries*>(list)->emplace_back(name, std::move(build));
  return 0;
}

}  // namespace

const std::vector<std::string>& PinnedEnvironment() {
  static const std::vector<std::string> settings = {
      "GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4",  // FMA variants of sin, exp, … differ in the last bits
      "GALLIUM_OVERRIDE_CPU_CAPS=sse4.1",                  // else llvmpipe compiles shaders for the machine's CPU
      "MESA_SHADER_CACHE_DISABLE=true",                    // cached shaders may be from another CPU
      "LP_NUM_THREADS=0",                                  // one process per core is faster than threads
      "LC_ALL=C.UTF-8",                                    // fixes number formats and sort orders in libraries
  };
  return settings;
}

const std::vector<std::string>& PassedVariables() {
  static const std::vector<std::string> names = {
      "PATH",         "HOME",         "USER",          "LOGNAME",      "SHELL",       "PWD",
      "TMPDIR",       "TERM",         "COLUMNS",       "LINES",        "NO_COLOR",    "ETUDE_GL",
      "ASAN_OPTIONS", "LSAN_OPTIONS", "UBSAN_OPTIONS", "TSAN_OPTIONS", "GCOV_PREFIX", "GCOV_PREFIX_STRIP"};
  return names;
}

std::vector<std::string> ClosedEnvironment() {
  std::vector<std::string> closed = PinnedEnvironment();
  for (char** entry = environ; *entry != nullptr; ++entry) {
    if (Holds(PassedVariables(), NameOf(*entry))) closed.emplace_back(*entry);
  }
  return closed;
}

Result<void> EnterPinnedEnvironment() {
  const std::string restarted = std::string(kRestarted) + "=" + std::to_string(::getpid());
  const char* mark = std::getenv(kRestarted.data());
  const bool is_restarted = mark != nullptr && restarted.substr(kRestarted.size() + 1) == mark;
  ::unsetenv(kRestarted.data());
  if (IsClosed()) return {};
  if (is_restarted) return Fail({}, "the pinned environment cannot be set for this process");
  std::vector<std::string> environment = ClosedEnvironment();
  environment.push_back(restarted);
  if (const char* key = std::getenv(kKeyVariable)) environment.push_back(std::string(kKeyVariable) + "=" + key);
  std::vector<char*> variables;
  for (std::string& assignment : environment) variables.push_back(assignment.data());
  variables.push_back(nullptr);
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string line{std::istreambuf_iterator<char>(file), {}};
  std::vector<char*> arguments;
  for (std::size_t at = 0; at < line.size(); at += std::strlen(&line[at]) + 1) arguments.push_back(&line[at]);
  arguments.push_back(nullptr);
  ::execve("/proc/self/exe", arguments.data(), variables.data());
  return FailOfMachine("Etude cannot restart itself: {}", std::strerror(errno));
}

std::vector<std::pair<std::string, std::string>> LoadedLibraries() {
  Libraries libraries;
  ::dl_iterate_phdr(AddLibrary, &libraries);
  std::ranges::sort(libraries);
  return libraries;
}

}  // namespace etude
