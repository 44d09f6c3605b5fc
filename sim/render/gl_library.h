#pragma once

#include <string>

#include "engine/base/result.h"

namespace etude {

/// A library that makes OpenGL 3.3 core contexts without a window: OSMesa or EGL, both with Mesa's llvmpipe. The
/// functions keep all of their state in `context`.
struct GlLibrary {
  std::string name;  ///< "OSMesa", "EGL"
  Result<void*> (*make_context)() = nullptr;
  void (*destroy_context)(void* context) = nullptr;
  void (*make_current)(void* context) = nullptr;
  void* (*find_function)(const char* name) = nullptr;  ///< null if there is no such function
};

/// Opens a shared library. If the library is present but cannot be loaded (e.g. for lack of address space), the error
/// is marked as one of this machine.
Result<void*> OpenGlLibrary(const char* name, const char* file);

/// Loads OSMesa. Fails if it is missing now or was missing at build time.
Result<GlLibrary> LoadOsMesa();

/// Loads EGL and opens Mesa's display without a surface. Fails if it is missing now or was missing at build time, or if
/// the display is not Mesa's.
Result<GlLibrary> LoadEgl();

/// Fails if the environment variable ETUDE_GL is set to anything but "osmesa" or "egl".
Result<void> CheckGlChoice();

/// Returns the library with which this process draws: the one that ETUDE_GL names, or else OSMesa if present, or else
/// EGL. It is loaded at the first call and not at program start, because it brings a compiler (LLVM) whose loading
/// takes longer than that of most other libraries together.
const Result<GlLibrary>& LoadedGlLibrary();

}  // namespace etude
