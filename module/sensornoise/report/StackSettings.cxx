// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "sensornoise/report/StackSettings.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <string>
#include <zlib.h>

namespace sensornoise
{

void
NoteCodes(Report & report, const CodeSettings & codes)
{
  const auto note = [&report](const char * name, const auto & given) {
    if (given)
    {
      report.settings.emplace_back(name, static_cast<double>(*given));
    }
  };
  note("bit_depth", codes.bitDepth);
  note("clip_low", codes.clipLowDn);
  note("clip_high", codes.clipHighDn);
  note("quantisation_step", codes.quantisationStepDn);
}

void
NoteMask(Report & report, const FrameGeometry & geometry, const std::vector<std::uint8_t> & mask)
{
  if (mask.empty())
  {
    return;
  }
  const std::string shape = std::to_string(geometry.width) + "x" + std::to_string(geometry.height) + ":";
  uLong sum = crc32(0, reinterpret_cast<const unsigned char *>(shape.data()), static_cast<uInt>(shape.size()));
  std::vector<unsigned char> row(geometry.width);
  for (std::size_t y = 0; y < geometry.height; ++y)
  {
    const auto first = mask.begin() + static_cast<std::ptrdiff_t>(y * geometry.width);
    std::transform(first, first + static_cast<std::ptrdiff_t>(geometry.width), row.begin(), [](std::uint8_t value) {
      return static_cast<unsigned char>(value != 0);
    });
    sum = crc32(sum, row.data(), static_cast<uInt>(row.size()));
  }
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%08lx", sum & 0xffffffffUL);
  report.settings.emplace_back("mask_crc32", std::string(text.data()));
}

void
NoteSelection(Report & report, const StackSelection & selection)
{
  const auto note = [&report](const char * name, std::size_t number) {
    report.settings.emplace_back(name, static_cast<double>(number));
  };
  if (const auto & roi = selection.roi)
  {
    note("roi_x", (*roi)[0]);
    note("roi_y", (*roi)[1]);
    note("roi_width", (*roi)[2]);
    note("roi_height", (*roi)[3]);
  }
  if (const auto & frames = selection.frames)
  {
    note("frame_range_first", frames->first);
    note("frame_range_end", frames->second);
  }
}

} // namespace sensornoise
