#include "sim/render/gl_context.h"

#include <new>
#include <string_view>

#ifdef __SANITIZE_ADDRESS__
// Known leaks: OSMesa leaks 480 bytes per destroyed context, EGL leaks its display, and fontconfig leaks the data that
// it has read. The sanitizer calls this function in every program that links this file, so neither tests nor manual
// runs need LSAN_OPTIONS.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa\nleak:libEGL\nleak:libgallium\nleak:swrast_dri\nleak:libfontconfig\n";
}
#endif

namespace etude {
namespace {

/// Returns the log of a shader or a program.
std::string LogOf(PFNGLGETSHADERINFOLOGPROC get, GLuint object) {
  std::string log(4096, '\0');
  GLsizei length = 0;
  get(object, static_cast<GLsizei>(log.size()), &length, log.data());
  log.resize(static_cast<std::size_t>(length));
  return log;
}

Result<GLuint> CompileShader(const GlFunctions& gl, GLenum stage, const std::string& source) {
  const GLuint shader = gl.CreateShader(stage);
  const char* text = source.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = 0;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled) return shader;
  const std::string log = LogOf(gl.GetShaderInfoLog, shader);
  gl.DeleteShader(shader);
  return Fail({}, "this GL does not compile one of Etude's shaders: {}", log);
}

}  // namespace

Result<std::unique_ptr<GlContext>> GlContext::Create() {
  RETURN_IF_ERROR(LoadedGlLibrary());
  const GlLibrary& library = *LoadedGlLibrary();
  // Create the context.
  std::unique_ptr<GlContext> result(new GlContext(library));
  ASSIGN_OR_RETURN(result->context_, library.make_context());
  result->MakeCurrent();
// Load the functions.
#define ETUDE_GL_LOAD(name)                                                                           \
  result->functions_.name = reinterpret_cast<decltype(&gl##name)>(library.find_function("gl" #name)); \
  if (!result->functions_.name) return Fail({}, "{} lacks the OpenGL function gl{}", result->library(), #name);
  ETUDE_GL_FUNCTIONS(ETUDE_GL_LOAD)
#undef ETUDE_GL_LOAD
  // Accept only the renderer llvmpipe.
  const auto* renderer = reinterpret_cast<const char*>(result->functions_.GetString(GL_RENDERER));
  if (renderer == nullptr || !std::string_view(renderer).starts_with("llvmpipe")) {
    return Fail({}, "{} renders with {}; only Mesa's llvmpipe gives the same pixels on every machine", library.name,
                renderer == nullptr ? "an unknown renderer" : renderer);
  }
  return result;
}

GlContext::~GlContext() {
  if (context_) library_.destroy_context(context_);
}

void GlContext::MakeCurrent() { library_.make_current(context_); }

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
  return Fail({}, "this GL does not link one of Etude's shader programs: {}", LogOf(gl.GetProgramInfoLog, program));
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
