#include "io/drawing/canvas.h"

#include <cairo.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/angles.h"
#include "io/drawing/pixel_lanes.h"

namespace etude {
namespace {

using CairoSurface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

void SetPaint(cairo_t* cr, const Paint& paint) { cairo_set_source_rgba(cr, paint.r, paint.g, paint.b, paint.a); }

void OutlineBox(cairo_t* cr, const Box& box, double radius) {
  cairo_new_path(cr);
  if (radius <= 0) {
    cairo_rectangle(cr, box.x, box.y, box.width, box.height);
    return;
  }
  const double right = box.x + box.width, bottom = box.y + box.height;
  cairo_arc(cr, right - radius, box.y + radius, radius, -kPi / 2, 0);
  cairo_arc(cr, right - radius, bottom - radius, radius, 0, kPi / 2);
  cairo_arc(cr, box.x + radius, bottom - radius, radius, kPi / 2, kPi);
  cairo_arc(cr, box.x + radius, box.y + radius, radius, kPi, 1.5 * kPi);
  cairo_close_path(cr);
}

// Scales and shifts the coordinates so that an image of this size covers the box.
void StretchOver(cairo_t* cr, const Box& box, int width, int height) {
  cairo_translate(cr, box.x, box.y);
  cairo_scale(cr, box.width / width, box.height / height);
}

void SetFont(cairo_t* cr, double size, bool bold) {
  cairo_select_font_face(cr, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(cr, size);
}

cairo_status_t AppendBytes(void* out, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(out)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

// Computes, for each pixel at the upper left corner of a box with rounded corners, the share of the pixel that lies
// inside the box.
Image<double> CornerCover(int radius) {
  Image<double> cover(radius, radius);
  if (radius == 0) return cover;
  CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, radius, radius), cairo_surface_destroy);
  const Context context(cairo_create(surface.get()), cairo_destroy);
  OutlineBox(context.get(), {0, 0, 4.0 * radius, 4.0 * radius}, radius);
  cairo_fill(context.get());
  cairo_surface_flush(surface.get());
  const unsigned char* rows = cairo_image_surface_get_data(surface.get());
  for (int y = 0; y < radius; ++y) {
    for (int x = 0; x < radius; ++x)
      cover.At(x, y) = rows[y * cairo_image_surface_get_stride(surface.get()) + x] / 255.0;
  }
  return cover;
}

std::uint32_t Between(std::uint32_t under, std::uint32_t over, double share) {
  std::uint32_t pixel = 0;
  for (const int shift : {0, 8, 16}) {
    const double level =
        std::lerp(static_cast<double>(under >> shift & 255), static_cast<double>(over >> shift & 255), share);
    pixel |= static_cast<std::uint32_t>(level + 0.5) << shift;
  }
  return pixel;
}

// Removes the last character, which in UTF-8 is a leading byte with its continuation bytes.
void DropLastCharacter(std::string& text) {
  while (!text.empty() && (static_cast<unsigned char>(text.back()) & 0xC0) == 0x80) text.pop_back();
  if (!text.empty()) text.pop_back();
}

}  // namespace

struct Canvas::State {
  CairoSurface surface;
  Context context;
};

Canvas::Canvas(int width, int height) {
  CairoSurface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
  Context context(cairo_create(surface.get()), cairo_destroy);
  state_ = std::make_unique<State>(State{std::move(surface), std::move(context)});
}
Canvas::~Canvas() = default;
Canvas::Canvas(Canvas&&) noexcept = default;
Canvas& Canvas::operator=(Canvas&&) noexcept = default;

int Canvas::width() const { return cairo_image_surface_get_width(state_->surface.get()); }
int Canvas::height() const { return cairo_image_surface_get_height(state_->surface.get()); }

void Canvas::FillBox(const Box& box, const Paint& paint, double radius) {
  cairo_t* cr = state_->context.get();
  SetPaint(cr, paint);
  OutlineBox(cr, box, radius);
  cairo_fill(cr);
}

void Canvas::FillShade(const Box& box, const Paint& top, const Paint& bottom) {
  cairo_t* cr = state_->context.get();
  cairo_pattern_t* shade = cairo_pattern_create_linear(0, box.y, 0, box.y + box.height);
  cairo_pattern_add_color_stop_rgba(shade, 0, top.r, top.g, top.b, top.a);
  cairo_pattern_add_color_stop_rgba(shade, 1, bottom.r, bottom.g, bottom.b, bottom.a);
  cairo_set_source(cr, shade);
  OutlineBox(cr, box, 0);
  cairo_fill(cr);
  cairo_pattern_destroy(shade);
}

void Canvas::DrawImage(const ColourImage& image, const Box& box, double radius) {
  if (image.pixels.empty()) return;
  CairoSurface source(cairo_image_surface_create(CAIRO_FORMAT_RGB24, image.width, image.height), cairo_surface_destroy);
  unsigned char* rows = cairo_image_surface_get_data(source.get());
  const int stride = cairo_image_surface_get_stride(source.get());
  for (int y = 0; y < image.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < image.width; ++x) {
      const Rgb8 pixel = image.At(x, y);
      row[x] = static_cast<std::uint32_t>(pixel.r) << 16 | static_cast<std::uint32_t>(pixel.g) << 8 | pixel.b;
    }
  }
  cairo_surface_mark_dirty(source.get());

  cairo_t* cr = state_->context.get();
  cairo_save(cr);
  OutlineBox(cr, box, radius);
  cairo_clip(cr);
  StretchOver(cr, box, image.width, image.height);
  cairo_set_source_surface(cr, source.get(), 0, 0);
  // Repeats the outermost pixels, so that the soft edge of the clipping region does not blend with black.
  cairo_pattern_set_extend(cairo_get_source(cr), CAIRO_EXTEND_PAD);
  cairo_paint(cr);
  cairo_restore(cr);
}

void Canvas::Put(const Image<std::uint32_t>& picture, int left, int top, int radius) {
  cairo_surface_t* surface = state_->surface.get();
  cairo_surface_flush(surface);
  unsigned char* bytes = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  const Image<double> corner = CornerCover(radius);
  for (int y = 0; y < picture.height; ++y) {
    auto* row = reinterpret_cast<std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(top + y) * stride) + left;
    const std::uint32_t* from = &picture.At(0, y);
    const int edge = std::min(y, picture.height - 1 - y);
    const int round = edge < radius ? std::min(radius, picture.width / 2) : 0;
    std::copy(from + round, from + picture.width - round, row + round);
    for (int x = 0; x < round; ++x) {
      for (const int at : {x, picture.width - 1 - x}) row[at] = Between(row[at], from[at], corner.At(x, edge));
    }
  }
  cairo_surface_mark_dirty(surface);
}

void Canvas::DrawMask(const Mask& mask, const Box& box, const Paint& paint) {
  if (mask.pixels.empty()) return;
  CairoSurface source(cairo_image_surface_create(CAIRO_FORMAT_A8, mask.width, mask.height), cairo_surface_destroy);
  unsigned char* rows = cairo_image_surface_get_data(source.get());
  const int stride = cairo_image_surface_get_stride(source.get());
  for (int y = 0; y < mask.height; ++y) {
    for (int x = 0; x < mask.width; ++x) rows[static_cast<std::ptrdiff_t>(y) * stride + x] = mask.At(x, y) ? 255 : 0;
  }
  cairo_surface_mark_dirty(source.get());

  cairo_t* cr = state_->context.get();
  cairo_save(cr);
  StretchOver(cr, box, mask.width, mask.height);
  SetPaint(cr, paint);
  cairo_mask_surface(cr, source.get(), 0, 0);
  cairo_restore(cr);
}

void Canvas::DrawLine(const glm::dvec2& from, const glm::dvec2& to, double width, const Paint& paint) {
  DrawPath(std::array{from, to}, width, paint);
}

void Canvas::DrawPath(std::span<const glm::dvec2> points, double width, const Paint& paint) {
  cairo_t* cr = state_->context.get();
  SetPaint(cr, paint);
  cairo_set_line_width(cr, width);
  cairo_set_line_cap(cr, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(cr, CAIRO_LINE_JOIN_ROUND);
  cairo_new_path(cr);
  for (const glm::dvec2& point : points) cairo_line_to(cr, point.x, point.y);
  cairo_stroke(cr);
}

void Canvas::DrawDot(const glm::dvec2& centre, double radius, const Paint& paint) {
  cairo_t* cr = state_->context.get();
  SetPaint(cr, paint);
  cairo_new_path(cr);
  cairo_arc(cr, centre.x, centre.y, radius, 0, 2 * kPi);
  cairo_fill(cr);
}

void Canvas::DrawRing(const glm::dvec2& centre, double radius, double width, const Paint& paint) {
  cairo_t* cr = state_->context.get();
  SetPaint(cr, paint);
  cairo_set_line_width(cr, width);
  cairo_new_path(cr);
  cairo_arc(cr, centre.x, centre.y, radius, 0, 2 * kPi);
  cairo_stroke(cr);
}

void Canvas::DrawText(const glm::dvec2& origin, const std::string& text, double size, const Paint& paint, double room,
                      bool bold) {
  constexpr double kMinShare = 0.75, kStep = 0.25;
  // Shrink the font in small steps, then cut characters until the text fits.
  const double min_size = kMinShare * size;
  while (size > min_size && TextWidth(text, size, bold) > room) size = std::max(min_size, size - kStep);
  std::string shown = text;
  for (std::string cut = text; !cut.empty() && TextWidth(shown, size, bold) > room;) {
    DropLastCharacter(cut);
    shown = cut + "…";
  }
  cairo_t* cr = state_->context.get();
  SetFont(cr, size, bold);
  SetPaint(cr, paint);
  cairo_move_to(cr, origin.x, origin.y);
  cairo_show_text(cr, shown.c_str());
}

double Canvas::TextWidth(const std::string& text, double size, bool bold) const {
  cairo_t* cr = state_->context.get();
  SetFont(cr, size, bold);
  cairo_text_extents_t extents;
  cairo_text_extents(cr, text.c_str(), &extents);
  return extents.x_advance;
}

ColourImage Canvas::Pixels() const {
  cairo_surface_flush(state_->surface.get());
  const unsigned char* rows = cairo_image_surface_get_data(state_->surface.get());
  const int stride = cairo_image_surface_get_stride(state_->surface.get());
  ColourImage image(width(), height());
  for (int y = 0; y < image.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(rows + static_cast<std::ptrdiff_t>(y) * stride);
    for (int x = 0; x < image.width; ++x) {
      const std::uint32_t pixel = row[x];
      image.At(x, y) = {static_cast<std::uint8_t>(pixel >> 16), static_cast<std::uint8_t>(pixel >> 8),
                        static_cast<std::uint8_t>(pixel)};
    }
  }
  return image;
}

Image<std::uint32_t> Canvas::Copy() const {
  cairo_surface_flush(state_->surface.get());
  const unsigned char* bytes = cairo_image_surface_get_data(state_->surface.get());
  const int stride = cairo_image_surface_get_stride(state_->surface.get());
  Image<std::uint32_t> picture(width(), height());
  for (int y = 0; y < picture.height; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(bytes + static_cast<std::ptrdiff_t>(y) * stride);
    std::copy_n(row, picture.width, &picture.At(0, y));
  }
  return picture;
}

void Canvas::ToI420(std::uint8_t* planes) const {
  cairo_surface_flush(state_->surface.get());
  const unsigned char* bytes = cairo_image_surface_get_data(state_->surface.get());
  const int stride = cairo_image_surface_get_stride(state_->surface.get());
  PixelsToI420(bytes, stride, width(), height(), planes);
}

std::string Canvas::Png() const {
  std::string bytes;
  cairo_surface_write_to_png_stream(state_->surface.get(), AppendBytes, &bytes);
  return bytes;
}

}  // namespace etude
