#include "sim/render/gl_library.h"

#if ETUDE_HAS_OSMESA

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <array>

namespace etude {
namespace {

/// OSMesa's own functions. (OSMesaGetProcAddress returns only GL's functions.)
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) CreateContextAttribs = nullptr;
  decltype(&OSMesaDestroyContext) DestroyContext = nullptr;
  decltype(&OSMesaMakeCurrent) MakeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) GetProcAddress = nullptr;
} osmesa;

Result<void*> MakeOsMesaContext() {
  const int attributes[] = {OSMESA_FORMAT,
                            OSMESA_RGBA,
                            OSMESA_DEPTH_BITS,
                            0,
                            OSMESA_PROFILE,
                            OSMESA_CORE_PROFILE,
                            OSMESA_CONTEXT_MAJOR_VERSION,
                            3,
                            OSMESA_CONTEXT_MINOR_VERSION,
                            3,
                            0};
  void* context = osmesa.CreateContextAttribs(attributes, nullptr);
  if (context == nullptr) return Fail({}, "OSMesa gives no OpenGL 3.3 core context");
  return context;
}

void MakeOsMesaCurrent(void* context) {
  // OSMesa needs a default framebuffer of some size; nothing is drawn into it.
  static std::array<unsigned char, 64 * 64 * 4> unused{};
  osmesa.MakeCurrent(static_cast<OSMesaContext>(context), unused.data(), GL_UNSIGNED_BYTE, 64, 64);
}

}  // namespace

Result<GlLibrary> LoadOsMesa() {
  ASSIGN_OR_RETURN(void* const library, OpenGlLibrary("OSMesa", "libOSMesa.so.8"));
#define ETUDE_OSMESA_LOAD(name)                                                            \
  osmesa.name = reinterpret_cast<decltype(osmesa.name)>(::dlsym(library, "OSMesa" #name)); \
  if (!osmesa.name) return Fail({}, "OSMesa lacks the function OSMesa{}", #name);
  ETUDE_OSMESA_LOAD(CreateContextAttribs)
  ETUDE_OSMESA_LOAD(DestroyContext)
  ETUDE_OSMESA_LOAD(MakeCurrent)
  ETUDE_OSMESA_LOAD(GetProcAddress)
#undef ETUDE_OSMESA_LOAD
  return GlLibrary{
      .name = "OSMesa",
      .make_context = MakeOsMesaContext,
      .destroy_context = [](void* context) { osmesa.DestroyContext(static_cast<OSMesaContext>(context)); },
      .make_current = MakeOsMesaCurrent,
      .find_function = [](const char* name) { return reinterpret_cast<void*>(osmesa.GetProcAddress(name)); }};
}

}  // namespace etude

#else

etude::Result<etude::GlLibrary> etude::LoadOsMesa() { return Fail({}, "this program was built without OSMesa"); }

#endif
