#pragma once

#include <string>

#include "engine/base/result.h"

namespace etude {

/// A library that makes OpenGL 3.3 core contexts without a window: OSMesa or EGL, both Mesa's llvmpipe. Its functions
/// keep nothing but what stands in `context`.
struct GlLibrary {
  std::string name;  ///< "OSMesa", "EGL"
  Result<void*> (*make_context)() = nullptr;
  void (*destroy_context)(void* context) = nullptr;
  void (*make_current)(void* context) = nullptr;
  void* (*find_function)(const char* name) = nullptr;  ///< null for one that there is not
};

/// Opens a shared library. Fails with an error of this machine where the library is there and cannot be loaded: it lacks
/// something, such as address space.
Result<void*> OpenGlLibrary(const char* name, const char* file);

/// Loads OSMesa. Fails where it is missing, or was when this was built.
Result<GlLibrary> LoadOsMesa();

/// Loads EGL and opens Mesa's display without a surface. Fails where it is missing, or was when this was built, and
/// where the display is not Mesa's.
Result<GlLibrary> LoadEgl();

/// Fails when the variable ETUDE_GL holds neither "osmesa" nor "egl".
Result<void> CheckGlChoice();

/// Returns the library that this process draws with, loaded when first asked for: the one that ETUDE_GL names, else
/// OSMesa where it is there, else EGL. Each brings a compiler along (LLVM), whose loading takes longer than that of
/// most other libraries together: so none is loaded when a program starts, but by those who draw.
const Result<GlLibrary>& LoadedGlLibrary();

}  // namespace etude
