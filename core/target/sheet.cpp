// SPDX-License-Identifier: BSD-3-Clause
#include "target/sheet.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>
#include <zlib.h>

#include "target/sheet_drawing.h"

namespace lvcalib {
namespace {

constexpr double kPointsPerMm = 72.0 / 25.4;
// Cairo's images end here.
constexpr double kLongestImage_px = 32767.0;
// Largest deviation of a drawn circle from a true one: Cairo's tolerance is in device units, here
// points or pixels.
constexpr double kCurveTolerance = 0.005;
constexpr const char* kTitle = "Calibration target";

struct SurfaceDeleter {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct CairoDeleter {
  void operator()(cairo_t* cairo) const { cairo_destroy(cairo); }
};
using Surface = std::unique_ptr<cairo_surface_t, SurfaceDeleter>;
using Cairo = std::unique_ptr<cairo_t, CairoDeleter>;

// Where Cairo's output goes. A stop makes the next write fail, which ends the encoding.
struct Sink {
  std::string bytes;
  const RunContext* context = nullptr;
};

cairo_status_t append(void* closure, const unsigned char* data, unsigned int length) {
  auto& sink = *static_cast<Sink*>(closure);
  if (sink.context->stopped()) return CAIRO_STATUS_WRITE_ERROR;
  try {
    sink.bytes.append(reinterpret_cast<const char*>(data), length);
  } catch (const std::bad_alloc&) {
    return CAIRO_STATUS_NO_MEMORY;  // Exceptions must not pass through C.
  }
  return CAIRO_STATUS_SUCCESS;
}

Error failure(cairo_status_t status, const RunContext& context) {
  if (context.stopped()) return Error::cancelled();
  return Error::output(Message("the sheet cannot be drawn: %1", cairo_status_to_string(status)));
}

// Cairo writes text as outlines; a description keeps the parameters readable for programs. None of
// their characters needs escaping: the tag family is a known name, the rest are numbers.
void insert_description(std::string& svg, const Target& target) {
  const std::size_t root = svg.find("<svg");
  const std::size_t end = root == std::string::npos ? root : svg.find('>', root);
  if (end == std::string::npos) return;
  svg.insert(end + 1, std::string("\n<title>") + kTitle + "</title>\n<desc>" +
                          sheet_parameters(target) + "</desc>");
}

Result<std::string> draw_vector(const Target& target, SheetFormat format, const SheetLayout& layout,
                                const RunContext& context) {
  Sink sink{{}, &context};
  const Eigen::Vector2d page_pt = kPointsPerMm * layout.page_mm;
  const bool pdf = format == SheetFormat::kPdf;
  const Surface surface(
      pdf ? cairo_pdf_surface_create_for_stream(append, &sink, page_pt.x(), page_pt.y())
          : cairo_svg_surface_create_for_stream(append, &sink, page_pt.x(), page_pt.y()));
  if (pdf) {
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_TITLE, kTitle);
    cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_SUBJECT,
                                   sheet_parameters(target).c_str());
  }
  const Cairo cairo(cairo_create(surface.get()));
  cairo_set_tolerance(cairo.get(), kCurveTolerance);
  cairo_scale(cairo.get(), kPointsPerMm, kPointsPerMm);
  for (int page = 0; page < layout.page_count(); ++page) {
    context.report("draw", static_cast<double>(page) / layout.page_count(),
                   Message("page %1 of %2", page + 1, layout.page_count()));
    cairo_set_source_rgb(cairo.get(), 1, 1, 1);
    cairo_paint(cairo.get());
    cairo_set_source_rgb(cairo.get(), 0, 0, 0);
    if (!draw_sheet_page(cairo.get(), target, layout, page / layout.columns, page % layout.columns,
                         context)) {
      return Error::cancelled();
    }
    cairo_show_page(cairo.get());
  }
  cairo_surface_finish(surface.get());
  const cairo_status_t status = cairo_surface_status(surface.get());
  const cairo_status_t drawing = cairo_status(cairo.get());
  // A finished surface puts its context into that very state; anything else is a failure.
  if (status != CAIRO_STATUS_SUCCESS) return failure(status, context);
  if (drawing != CAIRO_STATUS_SUCCESS && drawing != CAIRO_STATUS_SURFACE_FINISHED) {
    return failure(drawing, context);
  }
  if (!pdf) insert_description(sink.bytes, target);
  return std::move(sink.bytes);
}

void append_big_endian(std::string& out, std::uint32_t value) {
  for (int shift = 24; shift >= 0; shift -= 8) {
    out += static_cast<char>((value >> static_cast<unsigned>(shift)) & 0xFFU);
  }
}

// Cairo does not say how large a pixel is; without a pHYs chunk a PNG prints at any size.
void insert_resolution(std::string& png, double dpi) {
  const auto per_metre = static_cast<std::uint32_t>(std::lround(dpi / 0.0254));
  std::string body = "pHYs";
  append_big_endian(body, per_metre);
  append_big_endian(body, per_metre);
  body += '\1';  // unit: metre
  std::string chunk;
  append_big_endian(chunk, static_cast<std::uint32_t>(body.size() - 4));
  chunk += body;
  append_big_endian(chunk,
                    static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()),
                                                     static_cast<uInt>(body.size()))));
  constexpr std::size_t kAfterHeader = 8 + 4 + 4 + 13 + 4;  // signature, IHDR chunk
  png.insert(kAfterHeader, chunk);
}

// Paints white in bands, so that a stop does not have to wait for a gigabyte.
bool paint_white(cairo_t* cairo, double width_px, double height_px, const RunContext& context) {
  constexpr double kBand_px = 1024;
  for (double y = 0; y < height_px; y += kBand_px) {
    if (context.stopped()) return false;
    cairo_rectangle(cairo, 0, y, width_px, kBand_px);
    cairo_fill(cairo);
  }
  return true;
}

Result<std::string> draw_image(const Target& target, const SheetLayout& layout, double dpi,
                               const RunContext& context) {
  if (!(dpi >= 1.0 && dpi <= 10'000.0)) {
    return Error::usage(Message("the resolution must be between 1 and 10000 dpi"));
  }
  const double scale = dpi / 25.4;
  // A millionth of a pixel is rounding, not content.
  const Eigen::Vector2d size_px = ((scale * layout.page_mm).array() - 1e-6).ceil();
  if (size_px.maxCoeff() > kLongestImage_px) {
    const double fits = kLongestImage_px * 25.4 / layout.page_mm.maxCoeff();
    return Error::usage(Message("the image would be %1 pixels long, more than 32767",
                                std::lround(size_px.maxCoeff())),
                        {}, Message("use --dpi %1 or a PDF", static_cast<int>(fits)));
  }
  // One byte a pixel: the alpha channel alone, written as grey. Ink takes alpha away.
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, static_cast<int>(size_px.x()),
                                                   static_cast<int>(size_px.y())));
  const Cairo cairo(cairo_create(surface.get()));
  context.report("draw", 0.0, Message("drawing"));
  cairo_set_source_rgba(cairo.get(), 0, 0, 0, 1);
  if (!paint_white(cairo.get(), size_px.x(), size_px.y(), context)) return Error::cancelled();
  cairo_set_operator(cairo.get(), CAIRO_OPERATOR_DEST_OUT);
  cairo_set_tolerance(cairo.get(), kCurveTolerance);
  cairo_scale(cairo.get(), scale, scale);
  if (!draw_sheet_page(cairo.get(), target, layout, 0, 0, context)) return Error::cancelled();
  if (cairo_status(cairo.get()) != CAIRO_STATUS_SUCCESS) {
    return failure(cairo_status(cairo.get()), context);
  }
  context.report("write", 0.5, Message("encoding"));
  Sink sink{{}, &context};
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &sink);
  if (status != CAIRO_STATUS_SUCCESS) return failure(status, context);
  insert_resolution(sink.bytes, dpi);
  return std::move(sink.bytes);
}

}  // namespace

Result<std::string> draw_sheet(const Target& target, SheetFormat format,
                               const SheetOptions& options, const RunContext& context) {
  const auto layout = lay_out_sheet(target, options);
  if (!layout) return layout.error();
  if (context.stopped()) return Error::cancelled();
  if (format != SheetFormat::kPdf && layout->page_count() > 1) {
    return Error::usage(Message("the board takes %1 pages of %2, but only a PDF has several pages",
                                layout->page_count(), options.paper),
                        {}, Message("write a PDF, or leave the paper at 'board'"));
  }
  return format == SheetFormat::kPng ? draw_image(target, *layout, options.dpi, context)
                                     : draw_vector(target, format, *layout, context);
}

}  // namespace lvcalib
