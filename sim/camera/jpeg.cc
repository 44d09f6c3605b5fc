#include "sim/camera/jpeg.h"

// jpeglib.h wants these before it.
#include <jpeglib.h>

#include <cstddef>
#include <cstdio>
#include <cstdlib>

namespace etude {
namespace {

static_assert(sizeof(Rgb8) == 3, "a row's bytes are its colours");

JSAMPROW RowOf(const ColourImage& picture, JDIMENSION y) {
  const Rgb8* row = picture.pixels.data() + std::size_t{y} * static_cast<std::size_t>(picture.width);
  return const_cast<JSAMPROW>(reinterpret_cast<const JSAMPLE*>(row));  // libjpeg does not write what it encodes
}

}  // namespace

std::string EncodeJpeg(const ColourImage& picture, int quality) {
  jpeg_compress_struct job;
  jpeg_error_mgr errors;
  job.err = jpeg_std_error(&errors);  // ends the program when memory does
  jpeg_create_compress(&job);
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&job, &bytes, &size);
  job.image_width = static_cast<JDIMENSION>(picture.width);
  job.image_height = static_cast<JDIMENSION>(picture.height);
  job.input_components = 3;
  job.in_color_space = JCS_RGB;
  jpeg_set_defaults(&job);
  jpeg_set_quality(&job, quality, TRUE);
  job.dct_method = JDCT_ISLOW;
  jpeg_start_compress(&job, TRUE);
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
