#include "sim/camera/jpeg.h"

// jpeglib.h needs size_t and FILE; the headers that jpeg.h includes declare both.
#include <jpeglib.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdlib>

namespace etude {
namespace {

static_assert(sizeof(Rgb8) == 3, "a row's bytes are its colours");

JSAMPROW RowOf(const ColourImage& picture, JDIMENSION y) {
  const Rgb8* row = picture.pixels.data() + std::size_t{y} * static_cast<std::size_t>(picture.width);
  return const_cast<JSAMPROW>(reinterpret_cast<const JSAMPLE*>(row));  // libjpeg does not write to its input
}

// libjpeg reports a damaged file only through a callback that must not return; our callback leaves by longjmp.
struct JpegError {
  jpeg_error_mgr errors;  // must be the first member, because libjpeg gets a pointer to it alone
  std::jmp_buf way_out;
  std::array<char, JMSG_LENGTH_MAX> words;
};

void JumpOut(j_common_ptr job) {
  auto* jpeg_error = reinterpret_cast<JpegError*>(job->err);
  job->err->format_message(job, jpeg_error->words.data());
  std::longjmp(jpeg_error->way_out, 1);
}

// Negative levels are warnings of damage; other levels are traces.
void JumpOnWarning(j_common_ptr job, int level) {
  if (level < 0) JumpOut(job);
}

// Decodes the size, and also the pixels if `picture` is given. Returns false if the file is damaged; `jpeg_error` then
// holds the message. No object here has a destructor, so the jump leaks nothing.
bool DecodeUntrusted(std::string_view jpeg, JpegError& jpeg_error, jpeg_decompress_struct& job, ColourImage* picture) {
  job.err = jpeg_std_error(&jpeg_error.errors);
  jpeg_error.errors.error_exit = JumpOut;
  jpeg_error.errors.emit_message = JumpOnWarning;
  jpeg_create_decompress(&job);
  // Control returns here after an error.
  if (setjmp(jpeg_error.way_out) != 0) return false;
  jpeg_mem_src(&job, reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size());
  jpeg_read_header(&job, TRUE);
  if (picture == nullptr) return true;
  // Decode row by row.
  job.out_color_space = JCS_RGB;
  job.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&job);
  while (job.output_scanline < job.output_height) {
    JSAMPROW row = RowOf(*picture, job.output_scanline);
    jpeg_read_scanlines(&job, &row, 1);
  }
  jpeg_finish_decompress(&job);
  return true;
}

}  // namespace

Result<ColourImage> ReadJpeg(std::string_view jpeg, std::size_t max_pixels) {
  // Read the size, and check it before memory is allocated.
  JpegError jpeg_error{};
  jpeg_decompress_struct job{};
  bool is_read = DecodeUntrusted(jpeg, jpeg_error, job, nullptr);
  const std::size_t width = job.image_width, height = job.image_height;
  jpeg_destroy_decompress(&job);
  constexpr std::size_t kMaxSide = 16'384;  // the largest side of a picture in GL
  if (is_read && (width * height > max_pixels || std::max(width, height) > kMaxSide)) {
    return Fail({}, "the JPEG picture has {} x {} pixels; allowed: at most {} pixels in all, and {} a side", width,
                height, max_pixels, kMaxSide);
  }
  // Read the pixels.
  ColourImage picture;
  if (is_read) {
    picture = ColourImage(static_cast<int>(width), static_cast<int>(height));
    job = {};
    is_read = DecodeUntrusted(jpeg, jpeg_error, job, &picture);
    jpeg_destroy_decompress(&job);
  }
  if (!is_read) return Fail({}, "a damaged JPEG picture: {}", jpeg_error.words.data());
  return picture;
}

std::string EncodeJpeg(const ColourImage& picture, int quality) {
  jpeg_compress_struct job;
  jpeg_error_mgr errors;
  job.err = jpeg_std_error(&errors);  // terminates the program if memory runs out
  jpeg_create_compress(&job);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&job, &bytes, &size);
  // Describe the input.
  job.image_width = static_cast<JDIMENSION>(picture.width);
  job.image_height = static_cast<JDIMENSION>(picture.height);
  job.input_components = 3;
  job.in_color_space = JCS_RGB;
  jpeg_set_defaults(&job);
  jpeg_set_quality(&job, quality, TRUE);
  job.dct_method = JDCT_ISLOW;
  jpeg_start_compress(&job, TRUE);
  // Encode row by row.
  while (job.next_scanline < job.image_height) {
    JSAMPROW row = RowOf(picture, job.next_scanline);
    jpeg_write_scanlines(&job, &row, 1);
  }
  jpeg_finish_compress(&job);
  std::string file(reinterpret_cast<const char*>(bytes), size);
  jpeg_destroy_compress(&job);
  std::free(bytes);
  return file;
}

void DecodeJpeg(const std::string& jpeg, ColourImage& picture) {
  jpeg_decompress_struct job;
  jpeg_error_mgr errors;
  job.err = jpeg_std_error(&errors);
  jpeg_create_decompress(&job);
  jpeg_mem_src(&job, reinterpret_cast<const unsigned char*>(jpeg.data()), jpeg.size());
  jpeg_read_header(&job, TRUE);
  // Decode row by row.
  job.out_color_space = JCS_RGB;
  job.dct_method = JDCT_ISLOW;
  jpeg_start_decompress(&job);
  picture.width = static_cast<int>(job.output_width);
  picture.height = static_cast<int>(job.output_height);
  picture.pixels.resize(std::size_t{job.output_width} * job.output_height);
  while (job.output_scanline < job.output_height) {
    JSAMPROW row = RowOf(picture, job.output_scanline);
    jpeg_read_scanlines(&job, &row, 1);
  }
  jpeg_finish_decompress(&job);
  jpeg_destroy_decompress(&job);
}

}  // namespace etude
