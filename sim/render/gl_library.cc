#include "sim/render/gl_library.h"

#include <dlfcn.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string_view>

#include "engine/base/machine.h"
#include "engine/base/names.h"

namespace etude {
namespace {

std::string_view Choice() {
  const char* choice = std::getenv("ETUDE_GL");
  return choice == nullptr ? "" : choice;
}

Result<GlLibrary> Load() {
  RETURN_IF_ERROR(CheckGlChoice());
  // Parallel work is done by processes that may be forked from this process. Therefore GL must not start threads, not
  // even for its cache.
  ::setenv("LP_NUM_THREADS", "0", 0);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  if (Choice() == "osmesa") return LoadOsMesa();
  if (Choice() == "egl") return LoadEgl();
  auto by_osmesa = LoadOsMesa();
  if (by_osmesa) return by_osmesa;
  auto by_egl = LoadEgl();
  if (by_egl) return by_egl;
  const bool is_short = IsOfThisMachine(by_osmesa.error()) || IsOfThisMachine(by_egl.error());
  const std::string why =
      fmt::format("nothing can be drawn: {}; {}", by_osmesa.error().message, by_egl.error().message);
  if (is_short) return FailOfMachine("{}", why);
  return Fail({}, "{}", why);
}

}  // namespace

Result<void*> OpenGlLibrary(const char* name, const char* file) {
  if (void* const library = ::dlopen(file, RTLD_LAZY | RTLD_LOCAL)) return library;
  const std::string why = ::dlerror();
  const bool is_installed = why.find(std::strerror(ENOENT)) == std::string::npos;
  if (is_installed) return FailOfMachine("{} cannot be loaded: {}", name, why);
  return Fail({}, "{} cannot be loaded: {}", name, why);
}

Result<void> CheckGlChoice() {
  const std::string_view choice = Choice();
  if (choice.empty() || choice == "osmesa" || choice == "egl") return {};
  return Fail({"the environment variable ETUDE_GL"}, "found {}; allowed: osmesa, egl", Quote(choice));
}

const Result<GlLibrary>& LoadedGlLibrary() {
  static const Result<GlLibrary> loaded = Load();
  return loaded;
}

}  // namespace etude
