// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SvgAsPng.h"

#include <stdexcept>
#ifdef SENSORNOISE_LIBRSVG
#  include <cmath>
#  include <librsvg/rsvg.h>
#  include <memory>
#endif

namespace sensornoise::tools
{
#ifndef SENSORNOISE_LIBRSVG

void
RequirePng(const std::string & file)
{
  throw std::runtime_error("cannot write " + file +
                           ": this program was built without librsvg, which makes PNG of a figure; expected .svg or "
                           ".html, or a build with librsvg (Debian: librsvg2-dev)");
}

std::string
SvgAsPng(const std::string &)
{
  throw std::runtime_error("this program was built without librsvg");
}

#else
namespace
{
/** Pixels per unit of the figure. Two are sharp on high-resolution screens and in print. */
constexpr double PixelsPerUnit = 2.0;

struct Free
{
  void
  operator()(RsvgHandle * handle) const
  {
    g_object_unref(handle);
  }
  void
  operator()(GError * error) const
  {
    g_error_free(error);
  }
  void
  operator()(cairo_surface_t * surface) const
  {
    cairo_surface_destroy(surface);
  }
  void
  operator()(cairo_t * context) const
  {
    cairo_destroy(context);
  }
};

[[noreturn]] void
FailPng(const std::string & why)
{
  throw std::runtime_error("librsvg could not draw the figure: " + why);
}

[[noreturn]] void
FailPng(GError * error)
{
  const std::unique_ptr<GError, Free> owned(error);
  FailPng(std::string(error != nullptr ? error->message : "it does not say why"));
}

/** Returns the size of the figure: its width, and the height that follows from its view box. */
RsvgRectangle
SizeOfFigure(RsvgHandle * handle)
{
  gboolean      hasWidth = FALSE;
  gboolean      hasHeight = FALSE;
  gboolean      hasView = FALSE;
  RsvgLength    width{};
  RsvgLength    height{};
  RsvgRectangle view{};
  rsvg_handle_get_intrinsic_dimensions(handle, &hasWidth, &width, &hasHeight, &height, &hasView, &view);
  const bool isWidth = hasWidth != FALSE && width.unit == RSVG_UNIT_PX && width.length > 0.0;
  if (hasView == FALSE || !(view.width > 0.0) || !(view.height > 0.0))
  {
    FailPng("it has no view");
  }
  const double scale = PixelsPerUnit * (isWidth ? width.length / view.width : 1.0);
  return { 0.0, 0.0, std::round(scale * view.width), std::round(scale * view.height) };
}
} // namespace

void
RequirePng(const std::string &)
{}

std::string
SvgAsPng(const std::string & svg)
{
  GError *                                error = nullptr;
  const std::unique_ptr<RsvgHandle, Free> handle(
    rsvg_handle_new_from_data(reinterpret_cast<const guint8 *>(svg.data()), svg.size(), &error));
  if (!handle)
  {
    FailPng(error);
  }
  const RsvgRectangle                          page = SizeOfFigure(handle.get());
  const std::unique_ptr<cairo_surface_t, Free> surface(
    cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(page.width), static_cast<int>(page.height)));
  const std::unique_ptr<cairo_t, Free> context(cairo_create(surface.get()));
  if (rsvg_handle_render_document(handle.get(), context.get(), &page, &error) == FALSE)
  {
    FailPng(error);
  }
  std::string png;
  const auto  append = [](void * text, const unsigned char * data, unsigned int length) {
    static_cast<std::string *>(text)->append(reinterpret_cast<const char *>(data), length);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(surface.get(), append, &png);
  if (status != CAIRO_STATUS_SUCCESS)
  {
    FailPng(std::string(cairo_status_to_string(status)));
  }
  return png;
}
#endif

} // namespace sensornoise::tools
