#include "io/images/image_files.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <csetjmp>
#include <cstring>

#include "io/files/files.h"

namespace etude {
namespace {

// The size of an uncompressed picture with kMaxPictureSide pixels per side, rounded up.
constexpr std::uintmax_t kMaxPictureFileBytes = std::uintmax_t{1} << 28;
// The maximum side of a picture that DecodeColourPng accepts, pixels. GL and the JPEG reader have the same limit.
constexpr std::uint32_t kMaxSide = 16'384;
constexpr int kRunLengthOnly = 3;  // the value of zlib's Z_RLE

// --- PNG

/// Encodes 8-bit sRGB pixels as the bytes of a PNG file. `colour_type` is PNG_COLOR_TYPE_RGB or PNG_COLOR_TYPE_GRAY.
/// Filtered rows of camera pictures hold noise and runs of zeros but no repeated strings, so run-length coding gives
/// the same file size as zlib's default strategy in a sixth of the time.
std::string EncodePixels(const std::uint8_t* pixels, int width, int height, int colour_type,
                         double pixels_per_metre = 0) {
  assert(width > 0 && height > 0);
  std::string bytes;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_write_fn(
      png, &bytes,
      [](png_structp of, png_bytep data, std::size_t size) {
        static_cast<std::string*>(png_get_io_ptr(of))->append(reinterpret_cast<const char*>(data), size);
      },
      nullptr);
  png_set_IHDR(png, info, static_cast<png_uint_32>(width), static_cast<png_uint_32>(height), 8, colour_type,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB_gAMA_and_cHRM(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (pixels_per_metre > 0) {
    const auto density = static_cast<png_uint_32>(pixels_per_metre + 0.5);
    png_set_pHYs(png, info, density, density, PNG_RESOLUTION_METER);
  }
  png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_ALL_FILTERS);
  png_set_compression_strategy(png, kRunLengthOnly);
  png_write_info(png, info);
  const std::size_t row = png_get_rowbytes(png, info);
  for (int y = 0; y < height; ++y) png_write_row(png, pixels + static_cast<std::size_t>(y) * row);
  png_write_end(png, info);
  png_destroy_write_struct(&png, &info);
  return bytes;
}

// --- OpenEXR

Imf::Slice SliceOf(Imf::PixelType type, const void* pixels, const Imath::Box2i& window, std::size_t stride) {
  return Imf::Slice::Make(type, pixels, window, stride);
}

constexpr const char* kColourChannels[] = {"R", "G", "B"};
constexpr const char* kDepthChannel = "Z";
constexpr const char* kLabelChannel = "label";
constexpr const char* kNormalChannels[] = {"N.X", "N.Y", "N.Z"};

// Collects in memory the bytes that OpenEXR writes.
class ByteStream : public Imf::OStream {
 public:
  ByteStream() : Imf::OStream("a picture in memory") {}

  void write(const char* data, int count) override {
    const std::size_t end = at_ + static_cast<std::size_t>(count);
    if (bytes_.size() < end) bytes_.resize(end);
    std::memcpy(bytes_.data() + at_, data, static_cast<std::size_t>(count));
    at_ = end;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t position) override { at_ = position; }
  std::string TakeBytes() { return std::move(bytes_); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

// Writes an EXR file into `out`; OpenEXR's exceptions pass through.
void WriteExr(const View& view, const NormalImage& normals, std::span<const DepthChannel> measured, Imf::OStream& out) {
  // Add one channel for each picture that is not empty; colours are converted to linear light.
  const int width = std::max({view.colour.width, view.depth.width, view.labels.width});
  const int height = std::max({view.colour.height, view.depth.height, view.labels.height});
  Imf::Header header(width, height);
  header.compression() = Imf::ZIP_COMPRESSION;
  const Imath::Box2i& window = header.dataWindow();
  Imf::FrameBuffer channels;
  const auto add = [&](const char* name, Imf::PixelType type, const void* pixels, std::size_t stride) {
    header.channels().insert(name, Imf::Channel(type));
    channels.insert(name, SliceOf(type, pixels, window, stride));
  };

  // Convert colours to half floats, interleaved.
  std::vector<half> colour;
  for (const Rgb8& pixel : view.colour.pixels) {
    for (const std::uint8_t value : {pixel.r, pixel.g, pixel.b}) {
      colour.push_back(half(static_cast<float>(LinearOfSrgb(value))));
    }
  }
  if (!colour.empty()) {
    for (int i = 0; i < 3; ++i) add(kColourChannels[i], Imf::HALF, colour.data() + i, 3 * sizeof(half));
  }
  // Add depth, labels, normals, and further depth images.
  if (!view.depth.pixels.empty()) add(kDepthChannel, Imf::FLOAT, view.depth.pixels.data(), sizeof(float));
  // Labels are floats, because readers in browsers (three.js, parse-exr) misread integer channels.
  const std::vector<float> labels(view.labels.pixels.begin(), view.labels.pixels.end());
  if (!labels.empty()) add(kLabelChannel, Imf::FLOAT, labels.data(), sizeof(float));

  for (int i = 0; i < 3 && !normals.pixels.empty(); ++i) {
    add(kNormalChannels[i], Imf::FLOAT, &normals.pixels.front()[i], sizeof(glm::vec3));
  }
  for (const DepthChannel& channel : measured) {
    add(channel.name.c_str(), Imf::FLOAT, channel.depth.pixels.data(), sizeof(float));
  }

  // Write the pixels of all channels with one call.
  Imf::OutputFile file(out, header, 0);
  file.setFrameBuffer(channels);
  file.writePixels(height);
}

/// Reads the head of a PNG file, and refuses pictures that are too large. Afterwards, `png` refers to
/// `bytes`, which must outlive it.
Result<void> BeginPng(const std::string& bytes, const std::string& path, png_image& png) {
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) {
    return Fail({path}, "not a PNG picture: {}", png.message);
  }
  if (png.width > kMaxPictureSide || png.height > kMaxPictureSide) {
    png_image_free(&png);
    return Fail({path}, "found {} x {} pixels; allowed: at most {} pixels on each side", png.width, png.height,
                kMaxPictureSide);
  }
  return {};
}

/// The bytes of a PNG file that are not yet read.
struct PngBytes {
  const char* at;
  std::size_t left;
};

/// Reads the samples of a PNG of 16 bits without transparency as grey, without the conversion to another brightness
/// that libpng's simplified interface makes. `rows` points to the rows of `values`. Returns false for a damaged file.
bool ReadGrey16(const std::string& bytes, std::vector<png_bytep>& rows) {
  PngBytes source{bytes.data(), bytes.size()};
  png_structp png = png_create_read_struct(
      PNG_LIBPNG_VER_STRING, nullptr, [](png_structp of, png_const_charp) { png_longjmp(of, 1); },
      [](png_structp, png_const_charp) {});
  png_infop info = png_create_info_struct(png);
  // libpng reports errors by a jump to this place, over no object with a destructor.
  if (setjmp(png_jmpbuf(png)) != 0) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &source, [](png_structp of, png_bytep data, std::size_t size) {
    auto* const from = static_cast<PngBytes*>(png_get_io_ptr(of));
    if (size > from->left) png_error(of, "the file ends early");
    std::memcpy(data, from->at, size);
    from->at += size;
    from->left -= size;
  });
  png_read_info(png, info);
  if constexpr (std::endian::native == std::endian::little) png_set_swap(png);  // PNG stores the high byte first
  png_set_rgb_to_gray_fixed(png, PNG_ERROR_ACTION_NONE, -1, -1);                // equal channels keep their value
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

std::string EncodePng(const ColourImage& image, double pixels_per_metre) {
  static_assert(sizeof(Rgb8) == 3, "a picture is written as bytes of its colours");
  return EncodePixels(reinterpret_cast<const std::uint8_t*>(image.pixels.data()), image.width, image.height,
                      PNG_COLOR_TYPE_RGB, pixels_per_metre);
}

std::string EncodePng(const Mask& mask) {
  Mask grey = mask;
  for (std::uint8_t& pixel : grey.pixels) pixel = pixel ? 255 : 0;
  return EncodePixels(grey.pixels.data(), grey.width, grey.height, PNG_COLOR_TYPE_GRAY);
}

std::string EncodePpm(const ColourImage& image) {
  std::string bytes = fmt::format("P6\n{} {}\n255\n", image.width, image.height);
  return bytes.append(reinterpret_cast<const char*>(image.pixels.data()), 3 * image.pixels.size());
}

Result<MaskPicture> LoadMaskPng(const std::string& path) {
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(path, kMaxPictureFileBytes));
  png_image png{};
  RETURN_IF_ERROR(BeginPng(bytes, path, png));
  const auto width = static_cast<int>(png.width), height = static_cast<int>(png.height);
  constexpr png_uint_32 kMore = PNG_FORMAT_FLAG_COLORMAP | PNG_FORMAT_FLAG_ALPHA;
  MaskPicture mask{.values = {width, height}};
  // Keep the samples of opaque pictures of 16 bits, which may be small numbers.
  mask.has_16_bits = (png.format & PNG_FORMAT_FLAG_LINEAR) != 0 && (png.format & kMore) == 0;
  if (mask.has_16_bits) {
    png_image_free(&png);
    std::vector<png_bytep> rows;
    for (int y = 0; y < height; ++y) rows.push_back(reinterpret_cast<png_bytep>(&mask.values.At(0, y)));
    if (!ReadGrey16(bytes, rows)) return Fail({path}, "a damaged PNG picture");
    return mask;
  }
  // Keep the palette of a picture, so that pixels stay indices into the palette.
  mask.is_indexed = (png.format & PNG_FORMAT_FLAG_COLORMAP) != 0;
  const bool has_alpha = !mask.is_indexed && (png.format & PNG_FORMAT_FLAG_ALPHA) != 0;
  png.format = mask.is_indexed ? PNG_FORMAT_RGB_COLORMAP : has_alpha ? PNG_FORMAT_GA : PNG_FORMAT_GRAY;
  std::array<std::uint8_t, std::size_t{3} * 256> palette{};
  const png_color black{};
  const std::size_t size = has_alpha ? 2 : 1;
  std::vector<std::uint8_t> pixels(size * mask.values.pixels.size());
  if (!png_image_finish_read(&png, &black, pixels.data(), 0, palette.data())) {
    return Fail({path}, "a damaged PNG picture: {}", png.message);
  }
  if (!has_alpha) {
    std::ranges::copy(pixels, mask.values.pixels.begin());
    return mask;
  }
  // Blend transparent pixels with black.
  mask.alpha = {width, height};
  for (std::size_t i = 0; i < mask.values.pixels.size(); ++i) {
    const int grey = pixels[2 * i], alpha = pixels[2 * i + 1];
    mask.values.pixels[i] = static_cast<std::uint16_t>((grey * alpha + 127) / 255);
    mask.alpha.pixels[i] = static_cast<std::uint8_t>(alpha);
  }
  if (std::ranges::all_of(mask.alpha.pixels, [](std::uint8_t alpha) { return alpha == 255; })) mask.alpha = {};
  return mask;
}

Result<ColourImage> LoadColourPng(const std::string& path) {
  ASSIGN_OR_RETURN(const auto bytes, ReadWholeFile(path, kMaxPictureFileBytes));
  png_image png{};
  RETURN_IF_ERROR(BeginPng(bytes, path, png));
  png.format = PNG_FORMAT_RGB;
  ColourImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  const png_color black{};
  if (!png_image_finish_read(&png, &black, image.pixels.data(), 0, nullptr)) {
    return Fail({path}, "a damaged PNG picture: {}", png.message);
  }
  return image;
}

Result<ColourImage> DecodeColourPng(std::string_view bytes, std::size_t max_pixels) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_memory(&png, bytes.data(), bytes.size())) {
    return Fail({}, "not a PNG picture: {}", png.message);
  }
  const std::size_t pixels = std::size_t{png.width} * png.height;
  if (png.width > kMaxSide || png.height > kMaxSide || pixels > max_pixels) {
    png_image_free(&png);
    return Fail({}, "the PNG picture has {} x {} pixels; allowed: at most {} pixels in total, and {} on each side",
                png.width, png.height, max_pixels, kMaxSide);
  }
  png.format = PNG_FORMAT_RGBA;
  std::vector<std::array<std::uint8_t, 4>> with_alpha(pixels);
  if (!png_image_finish_read(&png, nullptr, with_alpha.data(), 0, nullptr)) {
    return Fail({}, "a damaged PNG picture: {}", png.message);
  }
  ColourImage image(static_cast<int>(png.width), static_cast<int>(png.height));
  std::ranges::transform(with_alpha, image.pixels.begin(), [](const auto& p) { return Rgb8{p[0], p[1], p[2]}; });
  return image;
}

Result<std::string> EncodeExr(const View& view, const NormalImage& normals, std::span<const DepthChannel> measured) {
  try {
    ByteStream stream;
    WriteExr(view, normals, measured, stream);
    return stream.TakeBytes();
  } catch (const std::exception& error) {
    return Fail({}, "the picture cannot be written as OpenEXR: {}", error.what());
  }
}

}  // namespace etude
