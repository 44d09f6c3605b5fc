#pragma once

#include <string>

#include "engine/base/result.h"

namespace etude {

/// A library that makes OpenGL 3.3 core contexts without a window: OSMesa or EGL, both with Mesa's llvmpipe. All state
/// of GL is in `context`.
struct GlLibrary {
  std::string name;  ///< "OSMesa", "EGL"
  Result<void*> (*make_context)() = nullptr;
  void (*destroy_context)(void* context) = nullptr;
  void (*make_current)(void* context) = nullptr;
  void* (*find_function)(const char* name) = nullptr;  ///< returns null for an unknown function
};

/// Opens a shared library. If the library exists but cannot be loaded (for example without enough address space), the
/// machine caused the error, so the error is made by `FailOfMachine`.
Result<void*> OpenGlLibrary(const char* name, const char* file);

/// Loads OSMesa. Fails if OSMesa is missing now or was missing at build time.
Result<GlLibrary> LoadOsMesa();

/// Loads EGL and opens Mesa's display without a surface. Fails if EGL is missing now or was missing at build time, or
/// if the display is not Mesa's.
Result<GlLibrary> LoadEgl();

/// Fails if the environment variable ETUDE_GL has a value other than "osmesa" or "egl".
Result<void> CheckGlChoice();

/// Returns the library with which this process draws: the library that ETUDE_GL names; without ETUDE_GL, OSMesa if it
/// is present, otherwise EGL. The library is loaded at the first call and not at program start: it includes a compiler
/// (LLVM), so loading it takes longer than loading most other libraries together.
const Result<GlLibrary>& LoadedGlLibrary();

}  // namespace etude
