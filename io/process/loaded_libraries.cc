#include "io/process/loaded_libraries.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <link.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <span>

namespace etude {
namespace {

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

std::vector<std::pair<std::string, std::string>> LoadedLibraries() {
  Libraries libraries;
  ::dl_iterate_phdr(AddLibrary, &libraries);
  std::ranges::sort(libraries);
  return libraries;
}

}  // namespace etude
