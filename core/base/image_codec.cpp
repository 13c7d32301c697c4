// SPDX-License-Identifier: BSD-3-Clause
#include "base/image_codec.h"

#include <algorithm>
#include <array>
#include <bit>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>

#include <jpeglib.h>
#include <png.h>
#include <tiffio.h>

#include "base/image_header.h"
#include "base/memory.h"

namespace lvcalib {
namespace {

// Larger than any camera used for calibration; guards against headers that claim absurd sizes.
constexpr long long kMaxPixels = 200'000'000;

Error damaged_data() {
  return Error::input(Message("the image cannot be decoded: its data are damaged"), {},
                      Message("copy or save the image again"));
}

void make_room(DecodedImage& image) {
  image.bytes.resize(image.row_bytes() * static_cast<std::size_t>(image.height_px));
}

std::uint8_t* row_of(DecodedImage& image, int row) {
  return image.bytes.data() + static_cast<std::size_t>(row) * image.row_bytes();
}

// libpng and libjpeg leave a failed call by longjmp, which runs no destructor: all that they use
// lives in these structs, outside the function that jumps.

struct PngReading {
  explicit PngReading(std::string_view bytes) : file(bytes) {
    png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, silent);
    if (png == nullptr) throw std::bad_alloc();
    info = png_create_info_struct(png);
    png_set_read_fn(png, this, read);
  }
  PngReading(const PngReading&) = delete;
  PngReading& operator=(const PngReading&) = delete;
  ~PngReading() { png_destroy_read_struct(&png, &info, nullptr); }

  static void silent(png_structp, png_const_charp) {}
  static void read(png_structp png, png_bytep to, std::size_t count) {
    auto* self = static_cast<PngReading*>(png_get_io_ptr(png));
    if (count > self->file.size() - self->at) png_error(png, "");
    std::memcpy(to, self->file.data() + self->at, count);
    self->at += count;
  }

  // Both return false where libpng fails.
  bool read_info() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_info(png, info);
    if (png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
    if (png_get_bit_depth(png, info) < 8) png_set_expand_gray_1_2_4_to_8(png);
    if (std::endian::native == std::endian::little) png_set_swap(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    return true;
  }
  bool read_rows() {
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_read_image(png, rows.data());
    png_read_end(png, nullptr);
    return true;
  }

  std::string_view file;
  std::size_t at = 0;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<png_bytep> rows;
};

Result<DecodedImage> decode_png(std::string_view file) {
  PngReading reading(file);
  if (reading.info == nullptr) throw std::bad_alloc();
  if (!reading.read_info()) return damaged_data();
  DecodedImage image;
  image.width_px = static_cast<int>(png_get_image_width(reading.png, reading.info));
  image.height_px = static_cast<int>(png_get_image_height(reading.png, reading.info));
  image.channels = png_get_channels(reading.png, reading.info);
  image.bits = png_get_bit_depth(reading.png, reading.info);
  if (png_get_rowbytes(reading.png, reading.info) != image.row_bytes()) return damaged_data();
  make_room(image);
  for (int y = 0; y < image.height_px; ++y) reading.rows.push_back(row_of(image, y));
  if (!reading.read_rows()) return damaged_data();
  return image;
}

struct JpegErrors {
  JpegErrors() {
    jpeg_std_error(&manager);
    manager.error_exit = [](j_common_ptr codec) {
      std::longjmp(reinterpret_cast<JpegErrors*>(codec->err)->failed, 1);
    };
    manager.output_message = [](j_common_ptr) {};
  }
  jpeg_error_mgr manager{};  // The first member: libjpeg hands on its address.
  std::jmp_buf failed{};
};

struct JpegReading {
  explicit JpegReading(std::string_view bytes) : file(bytes) {
    codec.err = &errors.manager;
    monitor.progress_monitor = [](j_common_ptr common) {
      // Every scan goes over the whole image: a small file of thousands takes minutes. Encoders
      // write a dozen.
      constexpr int kMostScans = 200;
      const auto* of = reinterpret_cast<jpeg_decompress_struct*>(common);
      if (of->input_scan_number > kMostScans) common->err->error_exit(common);
    };
  }
  JpegReading(const JpegReading&) = delete;
  JpegReading& operator=(const JpegReading&) = delete;
  ~JpegReading() { jpeg_destroy_decompress(&codec); }

  bool start() {
    if (setjmp(errors.failed) != 0) return false;
    jpeg_create_decompress(&codec);
    codec.progress = &monitor;
    jpeg_mem_src(&codec, reinterpret_cast<const unsigned char*>(file.data()), file.size());
    if (jpeg_read_header(&codec, 1) != JPEG_HEADER_OK) return false;
    const bool ink = codec.jpeg_color_space == JCS_CMYK || codec.jpeg_color_space == JCS_YCCK;
    codec.out_color_space = ink                                       ? JCS_CMYK
                            : codec.jpeg_color_space == JCS_GRAYSCALE ? JCS_GRAYSCALE
                                                                      : JCS_RGB;
    jpeg_start_decompress(&codec);
    return true;
  }
  bool read_row(std::uint8_t* to) {
    if (setjmp(errors.failed) != 0) return false;
    JSAMPROW rows[] = {to};
    return jpeg_read_scanlines(&codec, rows, 1) == 1;
  }

  std::string_view file;
  JpegErrors errors;
  jpeg_progress_mgr monitor{};
  jpeg_decompress_struct codec{};
};

Result<DecodedImage> decode_jpeg(std::string_view file) {
  JpegReading reading(file);
  if (!reading.start()) return damaged_data();
  DecodedImage image;
  image.width_px = static_cast<int>(reading.codec.output_width);
  image.height_px = static_cast<int>(reading.codec.output_height);
  const bool ink = reading.codec.out_color_space == JCS_CMYK;
  image.channels = ink ? 3 : reading.codec.output_components;
  make_room(image);
  std::vector<std::uint8_t> inks(ink ? 4 * static_cast<std::size_t>(image.width_px) : 0);
  for (int y = 0; y < image.height_px; ++y) {
    std::uint8_t* const row = row_of(image, y);
    if (!reading.read_row(ink ? inks.data() : row)) return damaged_data();
    // Adobe's files, the only ones with inks, hold how much paper they leave bare.
    for (std::size_t x = 0; x < inks.size() / 4; ++x) {
      for (std::size_t c = 0; c < 3; ++c)
        row[3 * x + c] = static_cast<std::uint8_t>(inks[4 * x + c] * inks[4 * x + 3] / 255);
    }
  }
  return image;
}

// Little-endian numbers; beyond the end, zero.
std::uint32_t little(std::string_view file, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t k = 0; k < bytes && at + k < file.size(); ++k) {
    value |= static_cast<std::uint32_t>(static_cast<unsigned char>(file[at + k]))
             << (8U * static_cast<unsigned>(k));
  }
  return value;
}

// Which bits of a pixel's number are one channel, scaled to 0…255.
std::uint8_t masked(std::uint32_t value, std::uint32_t mask) {
  if (mask == 0) return 0;
  const std::uint64_t most = mask >> static_cast<unsigned>(std::countr_zero(mask));
  const std::uint64_t level = (value & mask) >> static_cast<unsigned>(std::countr_zero(mask));
  return static_cast<std::uint8_t>((255 * level + most / 2) / most);
}

Result<DecodedImage> decode_bmp(std::string_view file) {
  const std::size_t first = little(file, 10, 4);
  const std::size_t header = little(file, 14, 4);
  const bool old = header == 12;
  const auto height = static_cast<std::int32_t>(little(file, 22, 4));
  DecodedImage image;
  image.width_px = static_cast<int>(little(file, 18, old ? 2 : 4));
  image.height_px = old ? static_cast<int>(little(file, 20, 2)) : std::abs(height);
  const std::uint32_t bits = little(file, old ? 24 : 28, 2);
  const std::uint32_t compression = old ? 0 : little(file, 30, 4);
  constexpr std::uint32_t kMasks = 3;
  constexpr std::array<std::uint32_t, 6> kBits{1, 4, 8, 16, 24, 32};
  if (std::find(kBits.begin(), kBits.end(), bits) == kBits.end()) return damaged_data();
  if (compression != 0 && !(compression == kMasks && bits >= 16)) {
    return Error::input(Message("a compressed bmp file, which cannot be read"), {},
                        Message("save the image as png"));
  }
  const std::size_t stride = (static_cast<std::size_t>(image.width_px) * bits + 31) / 32 * 4;
  const auto rows = static_cast<std::size_t>(image.height_px);
  if (first > file.size() || stride > (file.size() - first) / rows) return damaged_data();

  std::array<std::array<std::uint8_t, 3>, 256> palette{};
  bool grey = bits <= 8;
  if (bits <= 8) {
    const std::size_t entry = old ? 3 : 4;
    for (std::size_t k = 0; k < std::size_t{1} << bits; ++k) {
      const std::size_t at = 14 + header + k * entry;
      for (std::size_t c = 0; c < 3; ++c)
        palette[k][c] = static_cast<std::uint8_t>(little(file, at + 2 - c, 1));
      if (at + entry > first) break;
      grey = grey && palette[k][0] == palette[k][1] && palette[k][1] == palette[k][2];
    }
  }
  std::array<std::uint32_t, 3> masks{0x7C00, 0x03E0, 0x001F};
  if (bits >= 24) masks = {0xFF0000, 0x00FF00, 0x0000FF};
  if (compression == kMasks)
    for (std::size_t c = 0; c < 3; ++c) masks[c] = little(file, 54 + 4 * c, 4);

  image.channels = grey ? 1 : 3;
  make_room(image);
  for (std::size_t r = 0; r < rows; ++r) {
    const std::size_t from = first + stride * (height < 0 && !old ? r : rows - 1 - r);
    std::uint8_t* to = row_of(image, static_cast<int>(r));
    for (std::size_t x = 0; x < static_cast<std::size_t>(image.width_px); ++x) {
      if (bits <= 8) {
        const std::size_t at = x * bits / 8;
        const auto shift = static_cast<unsigned>(8 - bits - x * bits % 8);
        const std::uint32_t k = (little(file, from + at, 1) >> shift) & ((1U << bits) - 1U);
        for (int c = 0; c < image.channels; ++c) *to++ = palette[k][static_cast<std::size_t>(c)];
      } else {
        const std::uint32_t value = little(file, from + x * bits / 8, bits / 8);
        for (std::size_t c = 0; c < 3; ++c) *to++ = masked(value, masks[c]);
      }
    }
  }
  return image;
}

// A tiff file in memory, as libtiff asks for one.
struct TiffFile {
  std::string_view bytes;
  std::uint64_t at = 0;

  static TiffFile& of(thandle_t handle) { return *static_cast<TiffFile*>(handle); }
  static tmsize_t read(thandle_t handle, void* to, tmsize_t count) {
    TiffFile& file = of(handle);
    const std::uint64_t left = file.at < file.bytes.size() ? file.bytes.size() - file.at : 0;
    const auto taken = std::min(left, static_cast<std::uint64_t>(std::max<tmsize_t>(0, count)));
    std::memcpy(to, file.bytes.data() + (taken > 0 ? file.at : 0), taken);
    file.at += taken;
    return static_cast<tmsize_t>(taken);
  }
  static tmsize_t write(thandle_t, void*, tmsize_t) { return 0; }
  static toff_t seek(thandle_t handle, toff_t offset, int whence) {
    TiffFile& file = of(handle);
    file.at = offset + (whence == SEEK_CUR ? file.at : whence == SEEK_END ? file.bytes.size() : 0);
    return file.at;
  }
  static int close(thandle_t) { return 0; }
  static toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
};

int silent_tiff(TIFF*, void*, const char*, const char*, va_list) {
  return 1;
}

using TiffHandle = std::unique_ptr<TIFF, void (*)(TIFF*)>;

TiffHandle open_tiff(TiffFile& file) {
  const std::unique_ptr<TIFFOpenOptions, void (*)(TIFFOpenOptions*)> options(TIFFOpenOptionsAlloc(),
                                                                             TIFFOpenOptionsFree);
  if (!options) throw std::bad_alloc();
  TIFFOpenOptionsSetErrorHandlerExtR(options.get(), silent_tiff, nullptr);
  TIFFOpenOptionsSetWarningHandlerExtR(options.get(), silent_tiff, nullptr);
  // What a damaged directory may claim of one strip; pixels of 16 bits and four channels.
  TIFFOpenOptionsSetMaxSingleMemAlloc(options.get(), 8 * static_cast<tmsize_t>(kMaxPixels));
  return {TIFFClientOpenExt("", "rm", &file, TiffFile::read, TiffFile::write, TiffFile::seek,
                            TiffFile::close, TiffFile::size, nullptr, nullptr, options.get()),
          TIFFClose};
}

// All kinds of eight bits and fewer, by libtiff's own conversion.
bool read_as_bytes(TIFF* tiff, DecodedImage& image) {
  const auto width = static_cast<std::size_t>(image.width_px);
  std::vector<std::uint32_t> raster(width * static_cast<std::size_t>(image.height_px));
  constexpr int kStopOnError = 1;
  if (TIFFReadRGBAImageOriented(tiff, static_cast<std::uint32_t>(image.width_px),
                                static_cast<std::uint32_t>(image.height_px), raster.data(),
                                ORIENTATION_TOPLEFT, kStopOnError) == 0)
    return false;
  image.bits = 8;
  make_room(image);
  std::uint8_t* to = image.bytes.data();
  for (const std::uint32_t pixel : raster) {
    *to++ = static_cast<std::uint8_t>(TIFFGetR(pixel));
    if (image.channels == 1) continue;
    *to++ = static_cast<std::uint8_t>(TIFFGetG(pixel));
    *to++ = static_cast<std::uint8_t>(TIFFGetB(pixel));
  }
  return true;
}

// Sixteen bits, grey or colour, row by row.
bool read_rows_of_16(TIFF* tiff, bool inverted, DecodedImage& image) {
  image.bits = 16;
  if (TIFFScanlineSize64(tiff) != image.row_bytes()) return false;
  make_room(image);
  for (int y = 0; y < image.height_px; ++y) {
    if (TIFFReadScanline(tiff, row_of(image, y), static_cast<std::uint32_t>(y), 0) < 0)
      return false;
  }
  if (inverted)
    for (std::uint8_t& byte : image.bytes) byte = static_cast<std::uint8_t>(255 - byte);
  return true;
}

Result<DecodedImage> decode_tiff(std::string_view file, const ImageHeader& header) {
  TiffFile memory{file};
  const TiffHandle tiff = open_tiff(memory);
  if (!tiff) return damaged_data();
  const auto field = [&](std::uint32_t tag) {
    std::uint16_t value = 0;
    return TIFFGetFieldDefaulted(tiff.get(), tag, &value) == 1 ? value : std::uint16_t{0};
  };
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  TIFFGetField(tiff.get(), TIFFTAG_IMAGEWIDTH, &width);
  TIFFGetField(tiff.get(), TIFFTAG_IMAGELENGTH, &height);
  const std::uint16_t bits = field(TIFFTAG_BITSPERSAMPLE);
  const std::uint16_t format = field(TIFFTAG_SAMPLEFORMAT);
  const std::uint16_t kind = field(TIFFTAG_PHOTOMETRIC);
  if (bits > 16 || format == SAMPLEFORMAT_IEEEFP || format == SAMPLEFORMAT_COMPLEXIEEEFP) {
    return Error::input(Message("the image has neither 8 nor 16 bits per channel"), {},
                        Message("save it as 8 or 16 bit png"));
  }
  // Two readers of one directory must agree before memory is taken.
  if (width != header.width_px || height != header.height_px) return damaged_data();
  const bool grey = kind == PHOTOMETRIC_MINISBLACK || kind == PHOTOMETRIC_MINISWHITE;
  DecodedImage image;
  image.width_px = static_cast<int>(width);
  image.height_px = static_cast<int>(height);
  image.channels = grey ? 1 : 3;
  const bool by_rows = bits == 16 && (grey || kind == PHOTOMETRIC_RGB) &&
                       field(TIFFTAG_PLANARCONFIG) == PLANARCONFIG_CONTIG &&
                       field(TIFFTAG_ORIENTATION) == ORIENTATION_TOPLEFT &&
                       TIFFIsTiled(tiff.get()) == 0;
  if (by_rows) {
    image.channels = std::max<int>(1, field(TIFFTAG_SAMPLESPERPIXEL));
    if (image.channels > 4) return damaged_data();
  }
  const bool read = by_rows ? read_rows_of_16(tiff.get(), kind == PHOTOMETRIC_MINISWHITE, image)
                            : read_as_bytes(tiff.get(), image);
  if (!read) return damaged_data();
  return image;
}

struct PngWriting {
  PngWriting() {
    png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, PngReading::silent);
    if (png == nullptr) throw std::bad_alloc();
    info = png_create_info_struct(png);
    png_set_write_fn(png, this, write, [](png_structp) {});
  }
  PngWriting(const PngWriting&) = delete;
  PngWriting& operator=(const PngWriting&) = delete;
  ~PngWriting() { png_destroy_write_struct(&png, &info); }

  static void write(png_structp png, png_bytep from, std::size_t count) {
    static_cast<PngWriting*>(png_get_io_ptr(png))
        ->out.append(reinterpret_cast<const char*>(from), count);
  }
  bool run(const PixelView& pixels) {
    constexpr std::array kTypes{PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB,
                                PNG_COLOR_TYPE_RGB_ALPHA};
    if (setjmp(png_jmpbuf(png)) != 0) return false;
    png_set_compression_level(png, 1);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, PNG_FILTER_SUB);
    png_set_IHDR(png, info, static_cast<png_uint_32>(pixels.width_px),
                 static_cast<png_uint_32>(pixels.height_px), pixels.bits,
                 kTypes[static_cast<std::size_t>(pixels.channels - 1)], PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(png, info);
    if (pixels.bits == 16 && std::endian::native == std::endian::little) png_set_swap(png);
    for (std::size_t y = 0; y < static_cast<std::size_t>(pixels.height_px); ++y)
      png_write_row(png, pixels.data + y * pixels.row_bytes);
    png_write_end(png, info);
    return true;
  }

  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string out;
};

struct JpegWriting {
  JpegWriting() { codec.err = &errors.manager; }
  JpegWriting(const JpegWriting&) = delete;
  JpegWriting& operator=(const JpegWriting&) = delete;
  ~JpegWriting() {
    jpeg_destroy_compress(&codec);
    std::free(bytes);
  }
  bool run(const PixelView& pixels, int quality) {
    if (setjmp(errors.failed) != 0) return false;
    jpeg_create_compress(&codec);
    jpeg_mem_dest(&codec, &bytes, &size);
    codec.image_width = static_cast<JDIMENSION>(pixels.width_px);
    codec.image_height = static_cast<JDIMENSION>(pixels.height_px);
    codec.input_components = 1;
    codec.in_color_space = JCS_GRAYSCALE;
    jpeg_set_defaults(&codec);
    jpeg_set_quality(&codec, quality, 1);
    jpeg_start_compress(&codec, 1);
    for (std::size_t y = 0; y < static_cast<std::size_t>(pixels.height_px); ++y) {
      JSAMPROW rows[] = {const_cast<JSAMPROW>(pixels.data + y * pixels.row_bytes)};
      jpeg_write_scanlines(&codec, rows, 1);
    }
    jpeg_finish_compress(&codec);
    return true;
  }

  JpegErrors errors;
  jpeg_compress_struct codec{};
  unsigned char* bytes = nullptr;
  unsigned long size = 0;
};

bool has_pixels(const PixelView& p) {
  return p.data != nullptr && p.width_px > 0 && p.height_px > 0 && p.channels >= 1 &&
         p.channels <= 4 && (p.bits == 8 || p.bits == 16);
}

}  // namespace

Result<DecodedImage> decode_image(std::string_view file) {
  const auto header = read_image_header(file);
  if (!header) return header.error();
  if (header->width_px < 1 || header->height_px < 1 ||
      header->width_px > kMaxPixels / header->height_px) {
    return Error::input(Message("the image claims %1 × %2 pixels; expected 1 to %3 in all",
                                header->width_px, header->height_px, kMaxPixels));
  }
  // The decoders take a refusal of memory for damage. Pixels of 16 bits and four channels, and room
  // for themselves.
  constexpr std::size_t kOwn = std::size_t{8} << 20U;
  require_memory(8 * static_cast<std::size_t>(header->width_px) *
                     static_cast<std::size_t>(header->height_px) +
                 kOwn);
  if (file.starts_with('\x89')) return decode_png(file);
  if (file.starts_with('\xFF')) return decode_jpeg(file);
  if (file.starts_with("BM")) return decode_bmp(file);
  return decode_tiff(file, *header);
}

Result<std::string> encode_png(const PixelView& pixels) {
  if (!has_pixels(pixels))
    return Error::output(Message("the image has no pixels, so no PNG can be made of it"));
  PngWriting writing;
  if (writing.info == nullptr) throw std::bad_alloc();
  if (!writing.run(pixels)) return Error::output(Message("the image could not be encoded as PNG"));
  return std::move(writing.out);
}

Result<std::string> encode_grey_jpeg(const PixelView& pixels, int quality) {
  JpegWriting writing;
  if (!has_pixels(pixels) || pixels.channels != 1 || pixels.bits != 8 ||
      !writing.run(pixels, quality))
    return Error::output(Message("the image could not be encoded as JPEG"));
  return std::string(reinterpret_cast<const char*>(writing.bytes), writing.size);
}

}  // namespace lvcalib
