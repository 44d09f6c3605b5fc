#include "sim/render/renderer.h"

#include <cassert>
#include <cstddef>

#include "sim/render/capsule_batch.h"
#include "sim/render/frame_targets.h"
#include "sim/render/kept_rooms.h"
#include "sim/render/pixel_geometry.h"
#include "sim/render/shaders.h"
#include "sim/render/surface_batch.h"
#include "sim/render/vertex_stream.h"

namespace etude {
namespace {

// Surfaces beyond this depth are not drawn, metres.
constexpr float kFarthest = 200;

// A box as one triangle strip.
constexpr GLsizei kStripLength = 14;

// What draws one kind of body, and its shadow.
struct BodyPrograms {
  GLuint body = 0;
  GLuint shadow = 0;
};

struct Programs {
  GLuint room = 0;
  GLuint backdrop = 0;
  BodyPrograms capsules;
  BodyPrograms surfaces;
};

Result<Programs> LinkAll(const GlContext& context) {
  const std::vector<std::string> capsule{"start_and_radius", "end_and_label", "paint_in", "front_in"};
  const std::vector<std::string> corner{"place_in", "normal_in", "paint_in"};
  Programs programs;
  const struct {
    GLuint& out;
    std::string vertex, fragment;
    std::vector<std::string> attributes;
  } wanted[] = {
      {programs.room, FullScreenVertexShader(), RoomFragmentShader(), {}},
      {programs.backdrop, FullScreenVertexShader(), BackdropFragmentShader(), {}},
      {programs.capsules.body, CapsuleVertexShader(), CapsuleFragmentShader(), capsule},
      {programs.capsules.shadow, CapsuleShadowVertexShader(), CapsuleShadowFragmentShader(), capsule},
      {programs.surfaces.body, SurfaceVertexShader(), SurfaceFragmentShader(), corner},
      {programs.surfaces.shadow, SurfaceShadowVertexShader(), SurfaceShadowFragmentShader(), corner},
  };
  for (const auto& want : wanted) {
    ASSIGN_OR_RETURN(const auto program, context.LinkProgram(want.vertex, want.fragment, want.attributes));
    want.out = program;
  }
  return programs;
}

GLuint MakeVertexArray(const GlFunctions& gl) {
  GLuint vertices = 0;
  gl.GenVertexArrays(1, &vertices);
  return vertices;
}

// All bodies of one kind.
struct Bodies {
  BodyPrograms programs;
  VertexStream stream;
};

}  // namespace

struct Renderer::State {
  State(std::unique_ptr<GlContext> made, const Programs& linked)
      : context(std::move(made)),
        gl(context->functions()),
        backdrop(linked.backdrop),
        empty_vertices(MakeVertexArray(gl)),
        capsules{linked.capsules,
                 {gl,
                  sizeof(CapsuleInstance),
                  kStripLength,
                  {{4, offsetof(CapsuleInstance, start_and_radius)},
                   {4, offsetof(CapsuleInstance, end_and_label)},
                   {4, offsetof(CapsuleInstance, paint)},
                   {3, offsetof(CapsuleInstance, front)}}}},
        surfaces{linked.surfaces,
                 {gl,
                  sizeof(SurfaceCorner),
                  0,
                  {{3, offsetof(SurfaceCorner, place)},
                   {3, offsetof(SurfaceCorner, normal)},
                   {4, offsetof(SurfaceCorner, paint_and_label)}}}},
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
    Use(backdrop, brightness);
    targets.WriteOnly(true, all, all);
    gl.BindVertexArray(empty_vertices);
    gl.DrawArrays(GL_TRIANGLES, 0, 3);
  }

  void ThrowShadows(const Bodies& bodies, const Camera& camera, double brightness) {
    const GLuint program = bodies.programs.shadow;
    Use(program, brightness);
    SetPixelGeometry(gl, program, camera);
    for (const int onto_wall : {0, 1}) {
      gl.Uniform1i(gl.GetUniformLocation(program, "onto_wall"), onto_wall);
      bodies.stream.Draw();
    }
  }

  // Each body darkens on its own; where shadows overlap the darkest counts, not their product.
  void DrawShadows(const Camera& camera, double brightness, bool all) {
    targets.WriteOnly(true, all, false);
    gl.Enablei(GL_BLEND, 0);
    if (!capsules.stream.IsEmpty()) ThrowShadows(capsules, camera, brightness);
    if (!surfaces.stream.IsEmpty()) {
      for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Enable(plane);
      ThrowShadows(surfaces, camera, brightness);
      for (const GLenum plane : {GL_CLIP_DISTANCE0, GL_CLIP_DISTANCE1}) gl.Disable(plane);
    }
    gl.Disablei(GL_BLEND, 0);
  }

  void Draw(const Bodies& bodies, const Camera& camera, double brightness) {
    const GLuint program = bodies.programs.body;
    Use(program, brightness);
    SetPixelGeometry(gl, program, camera);
    gl.Uniform1f(gl.GetUniformLocation(program, "farthest"), kFarthest);
    bodies.stream.Draw();
  }

  void DrawBodies(const Camera& camera, double brightness, bool all) {
    targets.WriteOnly(true, all, all);
    gl.Enable(GL_DEPTH_TEST);
    if (!capsules.stream.IsEmpty()) {
      gl.Enable(GL_CULL_FACE);
      Draw(capsules, camera, brightness);
      gl.Disable(GL_CULL_FACE);
    }
    if (!surfaces.stream.IsEmpty()) Draw(surfaces, camera, brightness);
    gl.Disable(GL_DEPTH_TEST);
  }

  std::unique_ptr<GlContext> context;
  const GlFunctions& gl;
  GLuint backdrop;
  GLuint empty_vertices;
  Bodies capsules;
  Bodies surfaces;
  FrameTargets targets;
  KeptRooms rooms;
};

Renderer::Renderer(std::unique_ptr<State> state) : state_(std::move(state)) {}
Renderer::~Renderer() { state_->context->MakeCurrent(); }

Result<std::unique_ptr<Renderer>> Renderer::Create() {
  ASSIGN_OR_RETURN(auto context, GlContext::Create());
  ASSIGN_OR_RETURN(const auto programs, LinkAll(*context));
  return std::unique_ptr<Renderer>(new Renderer(std::make_unique<State>(std::move(context), programs)));
}

std::string RendererVersion() {
  const auto context = GlContext::Create();
  if (!context) return context.error().message;
  const auto* version = (*context)->functions().GetString(GL_VERSION);
  return version == nullptr ? "unknown version" : reinterpret_cast<const char*>(version);
}

View Renderer::Render(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets) {
  return RenderRows(room, figures, camera, targets, {0, camera.intrinsics.height});
}

View Renderer::RenderRows(const Room& room, const std::vector<Figure>& figures, const Camera& camera, Targets targets,
                          const RowRange& rows) {
  const int width = camera.intrinsics.width, height = camera.intrinsics.height;
  assert(width > 0 && height > 0 && width <= kLargestPicture && height <= kLargestPicture);
  assert(0 <= rows.first && rows.first < rows.end && rows.end <= height);
  const bool all = targets == Targets::kAll;

  state_->context->MakeCurrent();
  const GLuint kept_room = state_->rooms.FindOrDraw(room.texture_seed, camera);
  state_->targets.Begin(width, height, rows);
  state_->gl.BindTexture(GL_TEXTURE_2D, kept_room);
  state_->DrawBackdrop(room.brightness, all);

  state_->capsules.stream.Upload(MakeInstances(figures, camera.p_WC));
  state_->surfaces.stream.Upload(MakeCorners(figures, camera.p_WC));
  if (room.casts_shadows) state_->DrawShadows(camera, room.brightness, all);
  state_->DrawBodies(camera, room.brightness, all);
  state_->gl.Disable(GL_SCISSOR_TEST);  // kept rooms are drawn whole
  return state_->targets.Read(targets);
}

}  // namespace etude
