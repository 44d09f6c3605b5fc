#include "sim/render/renderer.h"

#include <cassert>
#include <cstddef>

#include "sim/render/capsule_batch.h"
#include "sim/render/frame_targets.h"
#include "sim/render/kept_rooms.h"
#include "sim/render/pixel_geometry.h"
#include "sim/render/shaders.h"

namespace etude {
namespace {

// Surfaces beyond this depth are not drawn, metres.
constexpr float kFarthest = 200;

// A box as one triangle strip.
constexpr GLsizei kStripLength = 14;

struct Programs {
  GLuint room = 0;
  GLuint backdrop = 0;
  GLuint shadow = 0;
  GLuint body = 0;
};

Result<Programs> LinkAll(const GlContext& context) {
  Programs programs;
  const struct {
    GLuint& out;
    std::string vertex, fragment;
  } wanted[] = {{programs.room, FullScreenVertexShader(), RoomFragmentShader()},
                {programs.backdrop, FullScreenVertexShader(), BackdropFragmentShader()},
                {programs.shadow, ShadowVertexShader(), ShadowFragmentShader()},
                {programs.body, BodyVertexShader(), BodyFragmentShader()}};
  for (const auto& want : wanted) {
    const auto program =
        context.LinkProgram(want.vertex, want.fragment, {"start_and_radius", "end_and_label", "paint_in", "front_in"});
    if (!program) return tl::unexpected(program.error());
    want.out = *program;
  }
  return programs;
}

GLuint MakeVertexArray(const GlFunctions& gl) {
  GLuint vertices = 0;
  gl.GenVertexArrays(1, &vertices);
  return vertices;
}

// A buffer of capsules, read once per instance.
GLuint MakeInstanceBuffer(const GlFunctions& gl, GLuint vertices) {
  GLuint buffer = 0;
  gl.GenBuffers(1, &buffer);
  gl.BindVertexArray(vertices);
  gl.BindBuffer(GL_ARRAY_BUFFER, buffer);
  const auto attribute = [&gl](GLuint index, int size, std::size_t offset) {
    gl.EnableVertexAttribArray(index);
    // NOLINTNEXTLINE(performance-no-int-to-ptr): what GL calls a pointer is an offset into the buffer
    const void* pointer = reinterpret_cast<const void*>(offset);
    gl.VertexAttribPointer(index, size, GL_FLOAT, GL_FALSE, sizeof(CapsuleInstance), pointer);
    gl.VertexAttribDivisor(index, 1);
  };
  attribute(0, 4, offsetof(CapsuleInstance, start_and_radius));
  attribute(1, 4, offsetof(CapsuleInstance, end_and_label));
  attribute(2, 4, offsetof(CapsuleInstance, paint));
  attribute(3, 3, offsetof(CapsuleInstance, front));
  return buffer;
}

}  // namespace

struct Renderer::State {
  State(std::unique_ptr<GlContext> made, const Programs& linked)
      : context(std::move(made)),
        gl(context->functions()),
        programs(linked),
        empty_vertices(MakeVertexArray(gl)),
        capsule_vertices(MakeVertexArray(gl)),
        capsule_buffer(MakeInstanceBuffer(gl, capsule_vertices)),
        targets(gl),
        rooms(gl, linked.room, empty_vertices) {
    gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    gl.CullFace(GL_FRONT);  // box faces turned away are in sight even from inside the box
    gl.BlendEquation(GL_MIN);
  }

  void Use(GLuint program, double brightness) {
    gl.UseProgram(program);
    gl.Uniform1f(gl.GetUniformLocation(program, "brightness"), static_cast<float>(brightness));
  }

  void DrawBackdrop(double brightness, bool all) {
    Use(programs.backdrop, brightness);
    targets.WriteOnly(true, all, all);
    gl.BindVertexArray(empty_vertices);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void Upload(const std::vector<CapsuleInstance>& capsules) {
    gl.BindVertexArray(capsule_vertices);
    gl.BindBuffer(GL_ARRAY_BUFFER, capsule_buffer);
    gl.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(capsules.size() * sizeof(CapsuleInstance)), capsules.data(),
                  GL_STREAM_DRAW);
  }

  // Each capsule darkens on its own; where shadows overlap the darkest counts, not their product.
  void DrawShadows(const Camera& camera, double brightness, bool all, GLsizei count) {
    Use(programs.shadow, brightness);
    SetPixelGeometry(gl, programs.shadow, camera);
    targets.WriteOnly(true, all, false);
    gl.Enablei(GL_BLEND, 0);
    for (const int onto_wall : {0, 1}) {
      gl.Uniform1i(gl.GetUniformLocation(programs.shadow, "onto_wall"), onto_wall);
      gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, kStripLength, count);
    }
    gl.Disablei(GL_BLEND, 0);
  }

  void DrawBodies(const Camera& camera, double brightness, bool all, GLsizei count) {
    Use(programs.body, brightness);
    SetPixelGeometry(gl, programs.body, camera);
    gl.Uniform1f(gl.GetUniformLocation(programs.body, "farthest"), kFarthest);
    targets.WriteOnly(true, all, all);
    gl.Enable(GL_CULL_FACE);
    gl.Enable(GL_DEPTH_TEST);
    gl.DrawArraysInstanced(GL_TRIANGLE_STRIP, 0, kStripLength, count);
    gl.Disable(GL_DEPTH_TEST);
    gl.Disable(GL_CULL_FACE);
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  Programs programs;
  GLuint empty_vertices;
  GLuint capsule_vertices;
  GLuint capsule_buffer;
  FrameTargets targets;
  KeptRooms rooms;
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() { state_->context->MakeCurrent(); }

Result<std::unique_ptr<Renderer>> Renderer::Create() {
  auto context = GlContext::Create();
  if (!context) return tl::unexpected(context.error());
  const auto programs = LinkAll(**context);
  if (!programs) return tl::unexpected(programs.error());
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(*context), *programs)));
}

std::string RendererVersion() {
  const auto context = GlContext::Create();
  if (!context) return context.error().message;
  const auto* version = (*context)->functions().GetString(GL_VERSION);
  return version == nullptr ? "unknown version" : reinterpret_cast<const char*>(version);
}

View Renderer::Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  assert(width > 0 && height > 0 && width <= kLargestPicture && height <= kLargestPicture);
  const bool all = targets == Targets::kAll;

  state_->context->MakeCurrent();
  const GLuint kept_room = state_->rooms.FindOrDraw(room.texture_seed, camera);
  state_->targets.Begin(width, height);
  state_->gl.BindTexture(GL_TEXTURE_2D, kept_room);
  state_->DrawBackdrop(room.brightness, all);

  const std::vector<CapsuleInstance> capsules = MakeInstances(figures, camera.p_WC);
  const auto count = static_cast<GLsizei>(capsules.size());
  if (count > 0) {
    state_->Upload(capsules);
    if (room.casts_shadows) state_->DrawShadows(camera, room.brightness, all, count);
    state_->DrawBodies(camera, room.brightness, all, count);
  }
  return state_->targets.Read(targets);
}

}  // namespace etude
