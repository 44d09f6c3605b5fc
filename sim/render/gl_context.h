#pragma once

// No other header includes GL; only this folder's .cc files include this header. The prototypes are only used as types.
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

#include <memory>
#include <string>
#include <vector>

#include "engine/base/result.h"
#include "sim/render/gl_library.h"

namespace etude {

// The list of all GL functions that this folder calls. Their addresses are requested by name from OSMesa or EGL,
// because the usual loaders (libepoxy, GLEW) do not work with OSMesa.
// clang-format off
#define ETUDE_GL_FUNCTIONS(X)                                                                                 \
  X(ActiveTexture) X(AttachShader) X(BindAttribLocation) X(BindBuffer) X(BindFramebuffer) X(BindRenderbuffer) \
  X(BindTexture) X(BindVertexArray) X(BlendEquation) X(BufferData) X(CheckFramebufferStatus) X(ClearBufferfv) \
  X(ClearBufferuiv) X(ColorMaski) X(CompileShader) X(CreateProgram) X(CreateShader) X(CullFace)               \
  X(DeleteFramebuffers) X(DeleteRenderbuffers) X(DeleteShader) X(DeleteTextures) X(DepthMask) X(Disable)      \
  X(Disablei) X(DrawArrays) X(DrawArraysInstanced) X(DrawBuffers) X(DrawElements) X(Enable) X(Enablei)        \
  X(EnableVertexAttribArray) X(FramebufferRenderbuffer) X(FramebufferTexture2D) X(GenBuffers)                 \
  X(GenerateMipmap) X(GenFramebuffers) X(GenRenderbuffers) X(GenTextures) X(GenVertexArrays) X(GetError)      \
  X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetUniformLocation)  \
  X(LinkProgram) X(PixelStorei) X(ReadBuffer) X(ReadPixels) X(RenderbufferStorage) X(Scissor) X(ShaderSource) \
  X(TexImage2D) X(TexParameteri) X(Uniform1f) X(Uniform1i) X(Uniform2f) X(Uniform3f) X(Uniform4fv)            \
  X(UniformMatrix3fv) X(UseProgram) X(VertexAttribDivisor) X(VertexAttribPointer) X(Viewport)
// clang-format on

/// The GL functions without the prefix "gl": `gl.Clear(…)`.
struct GlFunctions {
#define ETUDE_GL_MEMBER(name) decltype(&gl##name) name = nullptr;
  ETUDE_GL_FUNCTIONS(ETUDE_GL_MEMBER)
#undef ETUDE_GL_MEMBER
};

/// An offscreen context of OpenGL 3.3 core. Everything is drawn into our own framebuffer objects.
class GlContext {
 public:
  /// Fails if no library can be loaded, if the loaded library cannot make such a context, or if the library lacks a
  /// function. The error states the cause.
  static Result<std::unique_ptr<GlContext>> Create();
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  /// Directs all following GL calls to this context.
  void MakeCurrent();
  const GlFunctions& functions() const { return functions_; }
  /// Returns the name of the GL library: "OSMesa" or "EGL".
  const std::string& library() const { return library_.name; }

  /// Compiles and links a program; `attributes` get the locations 0, 1, 2, … in order. The error contains the
  /// compiler's own messages.
  Result<GLuint> LinkProgram(const std::string& vertex_source, const std::string& fragment_source,
                             const std::vector<std::string>& attributes = {}) const;

 private:
  explicit GlContext(const GlLibrary& library) : library_(library) {}

  const GlLibrary& library_;
  void* context_ = nullptr;
  GlFunctions functions_;
};

/// Throws std::bad_alloc if GL has run out of memory since the last call. Pictures drawn since then are not valid.
void CheckMemory(const GlFunctions& gl);

/// Makes a texture without filtering and leaves it bound.
GLuint MakeUnfilteredTexture(const GlFunctions& gl);

}  // namespace etude
