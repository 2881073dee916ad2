// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"
#include "files/FileBytes.h"
#include "files/Zlib.h"
#include "sensornoise/Report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace sensornoise
{
namespace
{
std::string
BigEndian(std::size_t number)
{
  return BytesOfNumber(number, 4, true);
}

const Bytef *
BytesOf(const std::string & text)
{
  return reinterpret_cast<const Bytef *>(text.data());
}

std::string
PngChunk(const std::string & name, const std::string & content)
{
  const std::string checked = name + content;
  return BigEndian(content.size()) + checked +
         BigEndian(crc32(crc32(0, nullptr, 0), BytesOf(checked), static_cast<uInt>(checked.size())));
}

std::string
Deflated(const std::string & text)
{
  uLongf      size = compressBound(static_cast<uLong>(text.size()));
  std::string packed(size, '\0');
  if (compress2(reinterpret_cast<Bytef *>(packed.data()),
                &size,
                BytesOf(text),
                static_cast<uLong>(text.size()),
                Z_DEFAULT_COMPRESSION) != Z_OK)
  {
    throw std::runtime_error("zlib cannot compress a picture of " + std::to_string(text.size()) + " bytes");
  }
  packed.resize(size);
  return packed;
}

std::string
Base64(const std::string & bytes)
{
  static const char * const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string               text;
  for (std::size_t i = 0; i < bytes.size(); i += 3)
  {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
    {
      three = three << 8U | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k)
    {
      text += i + k > bytes.size() ? '=' : digits[three >> (18 - 6 * k) & 63U];
    }
  }
  return text;
}

/** Returns an image of indices into a palette of red, green and blue, as a PNG in a "data:" URL. Throws
 * std::invalid_argument if there are not width x height pixels, or not 1 to 256 colours. Throws std::runtime_error if
 * zlib fails. */
std::string
PngAsDataAddress(std::size_t                                      width,
                 std::size_t                                      height,
                 const std::vector<std::uint8_t> &                pixels,
                 const std::vector<std::array<std::uint8_t, 3>> & palette)
{
  if (width == 0 || height == 0 || pixels.size() != width * height || palette.empty() || palette.size() > 256)
  {
    throw std::invalid_argument("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " has " +
                                std::to_string(pixels.size()) + " pixels and " + std::to_string(palette.size()) +
                                " colours; expected width x height pixels, and 1 to 256 colours");
  }
  const std::string kind = { 8, 3, 0, 0, 0 }; // 8 bits, palette, deflate, filter method 0, not interlaced
  std::string       colours;
  for (const auto & colour : palette)
  {
    colours.append(colour.begin(), colour.end());
  }
  std::string rows;
  for (std::size_t y = 0; y < height; ++y)
  {
    rows += '\0'; // filter type 0: none
    rows.append(reinterpret_cast<const char *>(&pixels[y * width]), width);
  }
  const std::string png = "\x89PNG\r\n\x1a\n" + PngChunk("IHDR", BigEndian(width) + BigEndian(height) + kind) +
                          PngChunk("PLTE", colours) + PngChunk("IDAT", Deflated(rows)) + PngChunk("IEND", "");
  return "data:image/png;base64," + Base64(png);
}

constexpr std::size_t MostPoints = 256; ///< largest width and height of a picture [points]

struct UseKind
{
  PixelUse                    use;
  const char *                words;
  std::array<std::uint8_t, 3> colour;
};

/** Uses in words, with their colours: light grey for used pixels, else colours of Okabe and Ito, further colours, and
 * greys of different lightness. */
constexpr std::array UseKinds{
  UseKind{ PixelUse::Used, "used", { 240, 240, 240 } },
  UseKind{ PixelUse::Clipped, "clipped", { 213, 94, 0 } },
  UseKind{ PixelUse::NotFinite, "not finite", { 0, 0, 0 } },
  UseKind{ PixelUse::Vibration, "gradient beyond noise", { 0, 158, 115 } },
  UseKind{ PixelUse::Border, "border", { 150, 150, 150 } },
  UseKind{ PixelUse::Constant, "never varies", { 95, 95, 95 } },
  UseKind{ PixelUse::FlickerUnknown, "flicker not known", { 120, 94, 240 } },
  UseKind{ PixelUse::Masked, "left out by the user", { 185, 185, 185 } },
  UseKind{ PixelUse::NearClip, "near a clip level", { 230, 159, 0 } },
  UseKind{ PixelUse::NotStatic, "something moves", { 0, 114, 178 } },
  UseKind{ PixelUse::Outlier, "noise of its own", { 204, 121, 167 } },
  UseKind{ PixelUse::CoarseQuantisation, "quantization too coarse", { 86, 180, 233 } },
  UseKind{ PixelUse::OutsideRange, "outside the level range", { 240, 228, 66 } },
  UseKind{ PixelUse::Edge, "edge of filtered frames", { 60, 20, 90 } },
  UseKind{ PixelUse::MaskedBorder, "masked border of the sensor", { 120, 80, 40 } },
};

constexpr bool
AreUsesInOrder()
{
  for (std::size_t i = 0; i < UseKinds.size(); ++i)
  {
    if (static_cast<std::size_t>(UseKinds[i].use) != i)
    {
      return false;
    }
  }
  return true;
}
static_assert(AreUsesInOrder(), "a colour is found by the value of its use");

/** Reduction of the maps to a picture of at most MostPoints x MostPoints points. A point stands for step x step pixels.
 */
struct Reduction
{
  std::size_t step;
  std::size_t width;
  std::size_t height;

  explicit Reduction(const PageMaps & maps)
    : step((std::max(maps.width, maps.height) + MostPoints - 1) / MostPoints)
    , width((maps.width + step - 1) / step)
    , height((maps.height + step - 1) / step)
  {}

  /** Calls \a work for the index of each pixel of a point. */
  template <typename TWork>
  void
  ForEachPixel(const PageMaps & maps, std::size_t point, TWork work) const
  {
    const std::size_t left = point % width * step;
    const std::size_t top = point / width * step;
    for (std::size_t y = top; y < std::min(top + step, maps.height); ++y)
    {
      for (std::size_t x = left; x < std::min(left + step, maps.width); ++x)
      {
        work(y * maps.width + x);
      }
    }
  }
};

std::string
ImageElement(const Reduction & reduction, const std::string & address, const std::string & words)
{
  return "<img alt=\"" + words + "\" width=\"" + std::to_string(reduction.width) + "\" height=\"" +
         std::to_string(reduction.height) + "\" src=\"" + address + "\">";
}

/** Returns the mean of the finite pixels of each point [DN]; NaN for a point without a finite pixel. */
std::vector<double>
ReducedMean(const PageMaps & maps, const Reduction & reduction)
{
  std::vector<double> points(reduction.width * reduction.height);
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    double      sum = 0.0;
    std::size_t count = 0;
    reduction.ForEachPixel(maps, point, [&](std::size_t pixel) {
      const bool isKnown = std::isfinite(maps.mean[pixel]);
      sum += isKnown ? maps.mean[pixel] : 0.0;
      count += isKnown ? 1 : 0;
    });
    points[point] = count > 0 ? sum / static_cast<double>(count) : std::numeric_limits<double>::quiet_NaN();
  }
  return points;
}

/** Returns the use of a point: Used, if more than seven eighths of its pixels are used, else the most frequent other
 * use. */
PixelUse
UseOfPoint(const PageMaps & maps, const Reduction & reduction, std::size_t point)
{
  std::array<std::size_t, UseKinds.size()> counts{};
  std::size_t                              total = 0;
  reduction.ForEachPixel(maps, point, [&](std::size_t pixel) {
    counts[std::min<std::size_t>(maps.pixelUse[pixel], counts.size() - 1)] += 1;
    ++total;
  });
  const auto most = std::max_element(counts.begin() + 1, counts.end());
  return 8 * (total - counts[0]) >= total ? static_cast<PixelUse>(most - counts.begin()) : PixelUse::Used;
}
} // namespace

std::string
MeanPicture(const PageMaps & maps)
{
  if (maps.IsEmpty() || maps.mean == nullptr)
  {
    return "";
  }
  const Reduction           reduction(maps);
  const std::vector<double> points = ReducedMean(maps, reduction);
  std::vector<double>       sorted;
  std::copy_if(points.begin(), points.end(), std::back_inserter(sorted), [](double x) { return std::isfinite(x); });
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](double fraction) {
    return sorted.empty() ? 0.0 : sorted[static_cast<std::size_t>(fraction * static_cast<double>(sorted.size() - 1))];
  };
  const double black = quantile(0.002);
  const double white = std::max(quantile(0.998), std::nextafter(black, std::numeric_limits<double>::max()));

  std::vector<std::array<std::uint8_t, 3>> greys;
  greys.reserve(256);
  for (int i = 0; i < 256; ++i)
  {
    const auto grey = static_cast<std::uint8_t>(i);
    greys.push_back({ grey, grey, grey });
  }
  std::vector<std::uint8_t> pixels;
  pixels.reserve(points.size());
  for (const double mean : points)
  {
    // a square root for the gamma of a screen, which is about 2
    const double brightness =
      std::isfinite(mean) ? std::sqrt(std::clamp((mean - black) / (white - black), 0.0, 1.0)) : 0.0;
    pixels.push_back(static_cast<std::uint8_t>(std::lround(255.0 * brightness)));
  }
  return "<figure>" +
         ImageElement(reduction, PngAsDataAddress(reduction.width, reduction.height, pixels, greys), "mean image") +
         "<figcaption>Mean image, black at " + Rounded(black) + " DN, white at " + Rounded(white) +
         " DN</figcaption></figure>\n";
}

std::string
PixelUsePicture(const PageMaps & maps)
{
  if (maps.IsEmpty() || maps.pixelUse == nullptr)
  {
    return "";
  }
  const Reduction                          reduction(maps);
  std::vector<std::array<std::uint8_t, 3>> palette;
  palette.reserve(UseKinds.size());
  for (const UseKind & kind : UseKinds)
  {
    palette.push_back(kind.colour);
  }
  std::vector<std::uint8_t> pixels;
  pixels.reserve(reduction.width * reduction.height);
  for (std::size_t point = 0; point < reduction.width * reduction.height; ++point)
  {
    pixels.push_back(static_cast<std::uint8_t>(UseOfPoint(maps, reduction, point)));
  }
  std::array<std::size_t, UseKinds.size()> counts{};
  for (std::size_t pixel = 0; pixel < maps.width * maps.height; ++pixel)
  {
    counts[std::min<std::size_t>(maps.pixelUse[pixel], counts.size() - 1)] += 1;
  }
  std::string legend;
  for (std::size_t i = 0; i < UseKinds.size(); ++i)
  {
    const auto & colour = UseKinds[i].colour;
    if (counts[i] > 0)
    {
      legend += "<li><i style=\"background:rgb(" + std::to_string(colour[0]) + "," + std::to_string(colour[1]) + "," +
                std::to_string(colour[2]) + ")\"></i>" + UseKinds[i].words + ", " +
                Percent(static_cast<double>(counts[i]) / static_cast<double>(maps.width * maps.height)) + "</li>";
    }
  }
  return "<figure>" +
         ImageElement(
           reduction, PngAsDataAddress(reduction.width, reduction.height, pixels, palette), "map of pixel use") +
         "<figcaption>What pixels serve for<ul class=\"legend\">" + legend + "</ul></figcaption></figure>\n";
}

} // namespace sensornoise
