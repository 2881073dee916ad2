// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "base/FreeMemory.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <fstream>
#include <initializer_list>
#include <sstream>
#include <stdexcept>

#ifdef __GLIBC__
#  include <malloc.h>
#endif
#ifdef __linux__
#  include <sys/resource.h>
#  include <unistd.h>
#endif

namespace sensornoise
{
namespace
{
/** Returns the sum of the numbers after these words, each at the beginning of a line; null if there is none. */
std::optional<double>
SumOf(const std::string & file, const std::initializer_list<const char *> & words)
{
  std::ifstream         lines(file);
  std::optional<double> sum;
  for (std::string line; std::getline(lines, line);)
  {
    std::istringstream fields(line);
    std::string        word;
    double             number = 0.0;
    if (fields >> word >> number && std::find(words.begin(), words.end(), word) != words.end())
    {
      sum = sum.value_or(0.0) + number;
    }
  }
  return sum;
}

/** Returns the number in a file; null if it is "max" or there is none. */
std::optional<double>
NumberIn(const std::string & file)
{
  std::ifstream in(file);
  double        number = 0.0;
  return in >> number ? std::optional<double>(number) : std::nullopt;
}

#ifdef __linux__
/** Returns the memory that the control group leaves to the process [bytes]. The cache of files counts as used, but can
 * be released. */
std::optional<double>
LeftByControlGroup()
{
  std::ifstream lines("/proc/self/cgroup");
  for (std::string line; std::getline(lines, line);)
  {
    const bool isV2 = line.rfind("0::", 0) == 0;
    const auto path = line.find(isV2 ? "::" : ":memory:");
    if (path == std::string::npos)
    {
      continue;
    }
    const std::string root = isV2 ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    const std::string own = line.substr(path + (isV2 ? 2 : 8));
    for (const std::string & folder : { root + own + "/", root + "/" }) // a container has its own group as the root
    {
      const auto limit = NumberIn(folder + (isV2 ? "memory.max" : "memory.limit_in_bytes"));
      const auto used = NumberIn(folder + (isV2 ? "memory.current" : "memory.usage_in_bytes"));
      if (limit && used)
      {
        return *limit - *used + SumOf(folder + "memory.stat", { "inactive_file", "active_file" }).value_or(0.0);
      }
    }
  }
  return std::nullopt;
}

std::optional<double>
LeftByProcessLimit()
{
  struct rlimit limit = {};
  const auto    pages = NumberIn("/proc/self/statm");
  if (getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY || !pages)
  {
    return std::nullopt;
  }
  return static_cast<double>(limit.rlim_cur) - *pages * static_cast<double>(sysconf(_SC_PAGESIZE));
}
#endif
} // namespace

std::optional<double>
FreeMemoryBytes()
{
#ifdef __linux__
  constexpr double      kibibyte = 1024.0;
  const auto            available = SumOf("/proc/meminfo", { "MemAvailable:", "SwapFree:" });
  std::optional<double> free;
  for (const std::optional<double> & left : { available ? std::optional<double>(*available * kibibyte) : std::nullopt,
                                              LeftByControlGroup(),
                                              LeftByProcessLimit() })
  {
    if (left)
    {
      free = std::max(0.0, std::min(*left, free.value_or(*left)));
    }
  }
  return free;
#else
  return std::nullopt;
#endif
}

void
RequireMemory(double bytes, const std::string & what)
{
  const std::optional<double> free = FreeMemoryBytes();
  if (free && bytes > *free)
  {
    throw std::runtime_error(what + " needs " + TextOfBytes(bytes) + " of memory, but " + TextOfBytes(*free) +
                             " are free");
  }
}

void
ReleaseFreedMemory()
{
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

std::string
TextOfBytes(double bytes)
{
  const std::array<const char *, 4> units{ "MB", "GB", "TB", "PB" };
  if (bytes < 1e3)
  {
    return std::to_string(static_cast<int>(bytes)) + " bytes";
  }
  double      value = bytes / 1e6;
  std::size_t unit = 0;
  for (; value >= 1000.0 && unit + 1 < units.size(); ++unit)
  {
    value /= 1000.0;
  }
  std::ostringstream text;
  text.precision(3);
  text << value << ' ' << units[unit];
  return text.str();
}

} // namespace sensornoise
