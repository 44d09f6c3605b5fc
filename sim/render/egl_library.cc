#include "sim/render/gl_library.h"

#if ETUDE_HAS_EGL

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <dlfcn.h>

#include <cstdlib>
#include <string_view>

namespace etude {
namespace {

/// The functions of EGL. They are looked up only in EGL's own library, because other loaded libraries may define the
/// same names.
struct Egl {
  decltype(&eglGetPlatformDisplay) GetPlatformDisplay = nullptr;
  decltype(&eglInitialize) Initialize = nullptr;
  decltype(&eglQueryString) QueryString = nullptr;
  decltype(&eglBindAPI) BindAPI = nullptr;
  decltype(&eglCreateContext) CreateContext = nullptr;
  decltype(&eglDestroyContext) DestroyContext = nullptr;
  decltype(&eglMakeCurrent) MakeCurrent = nullptr;
  decltype(&eglGetCurrentContext) GetCurrentContext = nullptr;
  decltype(&eglGetProcAddress) GetProcAddress = nullptr;
  EGLDisplay display = EGL_NO_DISPLAY;
} egl;

Result<void*> MakeEglContext() {
  const EGLint attributes[] = {
      EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
      EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
  void* context = egl.CreateContext(egl.display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes);
  if (context == EGL_NO_CONTEXT) return Fail({}, "EGL gives no OpenGL 3.3 core context");
  return context;
}

void MakeEglCurrent(void* context) { egl.MakeCurrent(egl.display, EGL_NO_SURFACE, EGL_NO_SURFACE, context); }

void DestroyEglContext(void* context) {
  // Release the context first if it is current, because EGL does not destroy a current context.
  if (egl.GetCurrentContext() == context) MakeEglCurrent(EGL_NO_CONTEXT);
  egl.DestroyContext(egl.display, context);
}

}  // namespace

Result<GlLibrary> LoadEgl() {
  // Select Mesa's software rasteriser, even on a machine with a graphics card.
  ::setenv("LIBGL_ALWAYS_SOFTWARE", "true", 1);
  ::setenv("GALLIUM_DRIVER", "llvmpipe", 1);
  ASSIGN_OR_RETURN(void* const library, OpenGlLibrary("EGL", "libEGL.so.1"));
#define ETUDE_EGL_LOAD(name)                                                      \
  egl.name = reinterpret_cast<decltype(egl.name)>(::dlsym(library, "egl" #name)); \
  if (!egl.name) return Fail({}, "EGL lacks the function egl{}; 1.5 is needed", #name);
  ETUDE_EGL_LOAD(GetPlatformDisplay)
  ETUDE_EGL_LOAD(Initialize)
  ETUDE_EGL_LOAD(QueryString)
  ETUDE_EGL_LOAD(BindAPI)
  ETUDE_EGL_LOAD(CreateContext)
  ETUDE_EGL_LOAD(DestroyContext)
  ETUDE_EGL_LOAD(MakeCurrent)
  ETUDE_EGL_LOAD(GetCurrentContext)
  ETUDE_EGL_LOAD(GetProcAddress)
#undef ETUDE_EGL_LOAD
  // Open Mesa's display without a surface.
  egl.display = egl.GetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
  if (egl.display == EGL_NO_DISPLAY || !egl.Initialize(egl.display, nullptr, nullptr)) {
    return Fail({}, "EGL cannot open Mesa's surfaceless display");
  }
  // Check that contexts need neither a configuration nor a surface.
  const char* extensions = egl.QueryString(egl.display, EGL_EXTENSIONS);
  for (const char* wanted : {"EGL_KHR_no_config_context", "EGL_KHR_surfaceless_context"}) {
    if (extensions == nullptr || std::string_view(extensions).find(wanted) == std::string_view::npos) {
      return Fail({}, "EGL lacks {}", wanted);
    }
  }
  if (!egl.BindAPI(EGL_OPENGL_API)) return Fail({}, "EGL gives no OpenGL");
  return GlLibrary{.name = "EGL",
                   .make_context = MakeEglContext,
                   .destroy_context = DestroyEglContext,
                   .make_current = MakeEglCurrent,
                   .find_function = [](const char* name) { return reinterpret_cast<void*>(egl.GetProcAddress(name)); }};
}

}  // namespace etude

#else

etude::Result<etude::GlLibrary> etude::LoadEgl() { return Fail({}, "this program was built without EGL"); }

#endif
