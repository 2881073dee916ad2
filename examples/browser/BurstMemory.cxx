// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "browser/BurstMemory.h"

#include "base/FreeMemory.h"
#include "base/Simd.h"
#include "refined/PixelProjections.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace sensornoise::browser
{
namespace
{
/** Frames that are read at a time [bytes], as by the filters. */
constexpr std::size_t ChunkBytes = std::size_t{ 32 } << 20;
/** Temporal components of illumination and motion that the stated need has room for: the most that are found [1]. */
constexpr std::size_t MostComponents = 20;
/** Memory of the program, the reports, and the sums of the second pass [bytes]; chosen empirically, twice its peak. */
constexpr double ProgramBytes = 64e6;

/** Returns the memory beside the method [bytes]: the program, the frames of a chunk, and one frame that is decoded. */
double
BytesBesideMethod(const Burst & burst)
{
  const double frameBytes = static_cast<double>(burst.geometry.Pixels()) * static_cast<double>(SizeOf(burst.pixel));
  return ProgramBytes + frameBytes * static_cast<double>(FramesPerChunk(burst) + 1);
}

/** Memory of a method without the frames [bytes]: the least with which it works, and the most that it uses. */
struct MethodNeed
{
  double leastBytes;
  double mostBytes;
};

MethodNeed
NeedOf(const Burst & burst, const BurstOptions & options)
{
  const std::size_t pixels = burst.geometry.Pixels();
  if (options.method != "refined")
  {
    constexpr double bytesPerPixel = 40.0; // need of the published method; the single-image method needs less
    const double     bytes = bytesPerPixel * static_cast<double>(pixels);
    return { bytes, bytes };
  }
  const MemoryNeed need{ pixels, burst.frames };
  return { need.Least(),
           std::max(need.Least(), need.BesideProjections() + need.OfProjections(MostComponents, SumWidth::Wide)) };
}
} // namespace

std::size_t
FramesPerChunk(const Burst & burst)
{
  const std::size_t frameBytes = burst.geometry.Pixels() * SizeOf(burst.pixel);
  return std::min(burst.frames, std::max(FramesTogether, ChunkBytes / std::max<std::size_t>(1, frameBytes)));
}

double
MemoryNeedOf(const Burst & burst, const BurstOptions & options)
{
  const MethodNeed need = NeedOf(burst, options);
  const double     beside = BytesBesideMethod(burst);
  return beside + std::max(need.leastBytes, std::min(need.mostBytes, PageMemoryBytes - beside));
}

double
MemoryLimitOf(const Burst & burst, const BurstOptions & options)
{
  const double room = PageMemoryBytes - BytesBesideMethod(burst);
  return NeedOf(burst, options).mostBytes > room ? room : std::numeric_limits<double>::infinity();
}

void
RequirePageMemory(const Burst & burst, const BurstOptions & options)
{
  const double need = MemoryNeedOf(burst, options);
  if (need > PageMemoryBytes)
  {
    throw std::runtime_error("the estimate of frames of " + std::to_string(burst.geometry.width) + " x " +
                             std::to_string(burst.geometry.height) + " pixels needs " + TextOfBytes(need) +
                             " of memory, but a page can use " + TextOfBytes(PageMemoryBytes) +
                             ". Use the program: estimate-sensor-noise " + burst.arguments + " --plot report.html");
  }
}

} // namespace sensornoise::browser
