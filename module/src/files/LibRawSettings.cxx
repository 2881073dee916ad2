// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifdef SENSORNOISE_LIBRAW
#  include "files/RawCameraFile.h"

#  include "base/Text.h"
#  include "files/TextHeader.h"

#  include <libraw/libraw.h>

#  include <algorithm>
#  include <array>
#  include <cmath>
#  include <cstddef>
#  include <cstdint>
#  include <limits>
#  include <vector>

namespace sensornoise
{
namespace
{
/** Returns maker and model. A model that begins with the maker stands alone. */
std::string
CameraNameOf(const libraw_iparams_t & about)
{
  const std::string make = PrintableText(about.make);
  const std::string model = PrintableText(about.model);
  return make.empty() || model.rfind(make, 0) == 0 ? model : PrintableText(make + " " + model);
}

/** Returns the Bayer pattern at the first pixel of the visible area; "" if the colours are no 2 x 2 mosaic. */
std::string
BayerPatternOf(LibRaw & raw)
{
  const libraw_iparams_t & about = raw.imgdata.idata;
  if (about.filters < 1000)
  {
    return "";
  }
  std::string pattern;
  for (int y = 0; y < 8; ++y)
  {
    for (int x = 0; x < 2; ++x)
    {
      const char letter = about.cdesc[raw.COLOR(y, x) & 3];
      if (y < 2)
      {
        pattern += letter;
      }
      else if (letter != pattern[static_cast<std::size_t>(2 * (y % 2) + x)])
      {
        return "";
      }
    }
  }
  static const std::array<const char *, 4> known{ { "RGGB", "GRBG", "GBRG", "BGGR" } };
  return std::any_of(known.begin(), known.end(), [&](const char * name) { return pattern == name; }) ? pattern : "";
}

/** Returns the black level if it is the same at every pixel [DN]; else NaN. */
double
BlackLevelOf(LibRaw & raw)
{
  const libraw_colordata_t & color = raw.imgdata.color;
  const unsigned             rows = color.cblack[4];
  const unsigned             columns = color.cblack[5];
  const bool isTable = rows > 0 && columns > 0 && std::uint64_t{ rows } * columns <= LIBRAW_CBLACK_SIZE - 6;
  const auto level = [&](unsigned y, unsigned x) {
    const auto     colour = static_cast<unsigned>(raw.COLOR(static_cast<int>(y), static_cast<int>(x)));
    const unsigned ofColour = color.cblack[colour < 4 ? colour : 0];
    const unsigned ofPlace = isTable ? color.cblack[6 + (y % rows) * columns + x % columns] : 0;
    return static_cast<double>(color.black) + ofColour + ofPlace;
  };
  const double first = level(0, 0);
  for (unsigned y = 0; y < (isTable ? 6 * rows : 6); ++y)
  {
    for (unsigned x = 0; x < (isTable ? 6 * columns : 6); ++x)
    {
      if (level(y, x) != first)
      {
        return std::numeric_limits<double>::quiet_NaN();
      }
    }
  }
  return first;
}

const unsigned short *
RowOf(const LibRaw & raw, std::size_t y)
{
  return raw.imgdata.rawdata.raw_image + y * (raw.imgdata.sizes.raw_pitch / sizeof(unsigned short));
}

unsigned int
BitDepthOf(const LibRaw & raw)
{
  const unsigned int said = raw.imgdata.color.raw_bps;
  const unsigned int white = raw.imgdata.color.maximum;
  if (said > 0 && said < 16)
  {
    return said;
  }
  unsigned int bits = 1;
  while (bits < 16 && (white >> bits) != 0)
  {
    ++bits;
  }
  const libraw_image_sizes_t & sizes = raw.imgdata.sizes;
  for (std::size_t y = sizes.top_margin; y < std::size_t{ sizes.top_margin } + sizes.height; ++y)
  {
    const unsigned short * const first = RowOf(raw, y) + sizes.left_margin;
    if (white == 0 || (*std::max_element(first, first + sizes.width) >> bits) != 0)
    {
      return 0;
    }
  }
  return bits;
}

/** Sets mean and standard error of the optical-black pixels that the file declares, if they have 8 rows or more. The
 * error is computed from the means of the rows, so that it includes row noise. */
void
AddOpticalBlack(const LibRaw & raw, CameraSettings & camera)
{
  constexpr std::size_t        fewestRows = 8;
  const libraw_image_sizes_t & sizes = raw.imgdata.sizes;
  std::vector<double>          sums(sizes.raw_height, 0.0);
  std::vector<double>          counts(sizes.raw_height, 0.0);
  for (const auto & mask : sizes.mask) // top, left, bottom, right
  {
    const int bottom = std::min<int>(mask[2], sizes.raw_height);
    const int right = std::min<int>(mask[3], sizes.raw_width);
    for (int y = std::max(mask[0], 0); y < bottom; ++y)
    {
      for (int x = std::max(mask[1], 0); x < right; ++x)
      {
        sums[static_cast<std::size_t>(y)] += RowOf(raw, static_cast<std::size_t>(y))[x];
        counts[static_cast<std::size_t>(y)] += 1.0;
      }
    }
  }
  std::vector<double> means;
  for (std::size_t y = 0; y < sums.size(); ++y)
  {
    if (counts[y] > 0.0)
    {
      means.push_back(sums[y] / counts[y]);
    }
  }
  if (means.size() < fewestRows)
  {
    return;
  }
  const auto rows = static_cast<double>(means.size());
  double     mean = 0.0;
  for (const double row : means)
  {
    mean += row / rows;
  }
  double squares = 0.0;
  for (const double row : means)
  {
    squares += (row - mean) * (row - mean);
  }
  camera.opticalBlackDn = mean;
  camera.opticalBlackErrorDn = std::sqrt(squares / (rows - 1.0) / rows);
}

double
PositiveOrNone(double value)
{
  return std::isfinite(value) && value > 0.0 ? value : std::numeric_limits<double>::quiet_NaN();
}

/** Returns the decimal number of fewest digits that is \a number in single precision: 0.01, not 0.009999999776. NaN
 * unless it is finite and above 0. */
double
ShortestDecimal(float number)
{
  const double value = PositiveOrNone(static_cast<double>(number));
  for (int digits = 1; std::isfinite(value) && digits <= std::numeric_limits<float>::max_digits10; ++digits)
  {
    const double decimal = FiniteNumber(GeneralText(value, digits)).value_or(value);
    if (static_cast<float>(decimal) == number)
    {
      return decimal;
    }
  }
  return value;
}
} // namespace

CameraSettings
CameraSettingsOf(LibRaw & raw)
{
  CameraSettings camera;
  camera.camera = CameraNameOf(raw.imgdata.idata);
  camera.bayerPattern = BayerPatternOf(raw);
  camera.bitDepth = BitDepthOf(raw);
  camera.blackLevelDn = BlackLevelOf(raw);
  camera.whiteLevelDn = PositiveOrNone(raw.imgdata.color.maximum);
  camera.isoSpeed = PositiveOrNone(static_cast<double>(raw.imgdata.other.iso_speed));
  camera.exposureSeconds = ShortestDecimal(raw.imgdata.other.shutter);
  AddOpticalBlack(raw, camera);
  return camera;
}

std::string
LossOf(LibRaw & raw)
{
  libraw_decoder_info_t decoder{};
  const bool            isKnown = raw.get_decoder_info(&decoder) == LIBRAW_SUCCESS && decoder.decoder_name != nullptr;
  std::string           name = isKnown ? decoder.decoder_name : "";
  const auto            has = [&name](const char * part) { return name.find(part) != std::string::npos; };
  if (has("sony_arw2"))
  {
    return "Sony's cRAW";
  }
  if (has("lossy_dng"))
  {
    return "lossy DNG";
  }
  if (has("nikon_coolscan") || has("kodak_jpeg") || has("kodak_ycbcr") || has("quicktake") || has("kodak_radc"))
  {
    return name;
  }
  // Nikon's EXIF: 1 and 4 are the lossy types 1 and 2
  const unsigned nikon = raw.imgdata.makernotes.nikon.NEFCompression;
  if (has("nikon") && (nikon == 1 || nikon == 4))
  {
    return "Nikon's lossy NEF";
  }
#  if LIBRAW_VERSION >= LIBRAW_MAKE_VERSION(0, 21, 0)
  // ExifTool's Canon tags: 7 is CRAW; older versions of LibRaw lack the tag
  if (has("crx") && raw.imgdata.makernotes.canon.Quality == 7)
  {
    return "Canon's C-RAW";
  }
#  endif
  return "";
}

} // namespace sensornoise
#endif
