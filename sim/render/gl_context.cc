#include "sim/render/gl_context.h"

#include <GL/osmesa.h>
#include <dlfcn.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>

#include "engine/base/machine.h"

#ifdef __SANITIZE_ADDRESS__
// OSMesa keeps 480 bytes of every destroyed context, fontconfig what it once read. The sanitizer asks every program
// that links this file for what it shall not report, so that neither the tests nor a run by hand needs LSAN_OPTIONS.
extern "C" const char* __lsan_default_suppressions() { return "leak:libOSMesa\nleak:libfontconfig\n"; }
#endif

namespace etude {
namespace {

Result<GLuint> CompileShader(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  gl.DeleteShader(shader);
  return Fail({}, "this GL refuses one of Etude's shaders: {}", log);
}

/// The functions of OSMesa that it cannot be asked for by name.
struct OsMesa {
  decltype(&OSMesaCreateContextAttribs) CreateContextAttribs = nullptr;
  decltype(&OSMesaDestroyContext) DestroyContext = nullptr;
  decltype(&OSMesaMakeCurrent) MakeCurrent = nullptr;
  decltype(&OSMesaGetProcAddress) GetProcAddress = nullptr;
};

Result<OsMesa> OpenOsMesa() {
  // Work in parallel is done by processes, which may be copies of this one: GL keeps no threads, not for its cache
  // either.
  ::setenv("LP_NUM_THREADS", "0", 0);
  ::setenv("MESA_SHADER_CACHE_DISABLE", "true", 0);
  void* library = ::dlopen("libOSMesa.so.8", RTLD_LAZY | RTLD_LOCAL);
  if (library == nullptr) {
    const std::string why = ::dlerror();
    // One that is there and cannot be loaded lacks something, such as address space.
    const bool is_installed = why.find(std::strerror(ENOENT)) == std::string::npos;
    return Fail({is_installed ? kThisMachine : ""}, "OSMesa cannot be loaded: {}", why);
  }
  OsMesa functions;
#define ETUDE_OSMESA_LOAD(name)                                                                  \
  functions.name = reinterpret_cast<decltype(functions.name)>(::dlsym(library, "OSMesa" #name)); \
  if (!functions.name) return Fail({}, "OSMesa lacks the function OSMesa{}", #name);
  ETUDE_OSMESA_LOAD(CreateContextAttribs)
  ETUDE_OSMESA_LOAD(DestroyContext)
  ETUDE_OSMESA_LOAD(MakeCurrent)
  ETUDE_OSMESA_LOAD(GetProcAddress)
#undef ETUDE_OSMESA_LOAD
  return functions;
}

const Result<OsMesa>& GetOsMesa() {
  static const Result<OsMesa> loaded = OpenOsMesa();
  return loaded;
}

}  // namespace

Result<void> GlContext::LoadLibrary() {
  if (!GetOsMesa()) return tl::unexpected(GetOsMesa().error());
  return {};
}

Result<std::unique_ptr<GlContext>> GlContext::Create() {
  ASSIGN_OR_RETURN(const OsMesa mesa, GetOsMesa());
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
  std::unique_ptr<GlContext> result(new GlContext);
  result->context_ = mesa.CreateContextAttribs(attributes, nullptr);
  if (!result->context_) return Fail({}, "OSMesa gives no OpenGL 3.3 core context");
  result->MakeCurrent();
#define ETUDE_GL_LOAD(type, name)                                                    \
  result->functions_.name = reinterpret_cast<type>(mesa.GetProcAddress("gl" #name)); \
  if (!result->functions_.name) return Fail({}, "OSMesa lacks the OpenGL function gl{}", #name);
  ETUDE_GL_FUNCTIONS(ETUDE_GL_LOAD)
#undef ETUDE_GL_LOAD
  return result;
}

GlContext::~GlContext() {
  if (context_) GetOsMesa()->DestroyContext(static_cast<OSMesaContext>(context_));
}

void GlContext::MakeCurrent() {
  GetOsMesa()->MakeCurrent(static_cast<OSMesaContext>(context_), unused_framebuffer_.data(), GL_UNSIGNED_BYTE, 64, 64);
}

Result<GLuint> GlContext::LinkProgram(const std::string& vertex_source, const std::string& fragment_source,
                                      const std::vector<std::string>& attributes) const {
  const GlFunctions& gl = functions_;
  ASSIGN_OR_RETURN(const auto vertex, CompileShader(gl, GL_VERTEX_SHADER, vertex_source));
  ASSIGN_OR_RETURN(const auto fragment, CompileShader(gl, GL_FRAGMENT_SHADER, fragment_source));
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, vertex);
  gl.AttachShader(program, fragment);
  for (std::size_t i = 0; i < attributes.size(); ++i) {
    gl.BindAttribLocation(program, static_cast<GLuint>(i), attributes[i].c_str());
  }
  gl.LinkProgram(program);
  gl.DeleteShader(vertex);
  gl.DeleteShader(fragment);
  GLint linked = 0;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked) return program;
  std::string log(4096, '\0');
  GLsizei length = 0;
  gl.GetProgramInfoLog(program, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return Fail({}, "this GL does not link one of Etude's shader programs: {}", log);
}

void CheckMemory(const GlFunctions& gl) {
  if (gl.GetError() == GL_OUT_OF_MEMORY) throw std::bad_alloc();
}

GLuint MakeUnfilteredTexture(const GlFunctions& gl) {
  GLuint texture = 0;
  gl.GenTextures(1, &texture);
  gl.BindTexture(GL_TEXTURE_2D, texture);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  return texture;
}

}  // namespace etude
