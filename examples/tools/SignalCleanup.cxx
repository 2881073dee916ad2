// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "tools/SignalCleanup.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <unistd.h>

namespace sensornoise::tools
{
namespace
{
/** Path that a signal handler, which may not allocate, can read. */
struct Slot
{
  std::atomic<bool>      isUsed{ false };
  std::array<char, 4096> path{}; // PATH_MAX of Linux
};
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler may read no other atomic");

std::array<Slot, 32> slots; // estimate-sensor-noise: report, plot, ten maps, and each folder that it makes

extern "C" void
RemoveAndEnd(int signal)
{
  for (auto slot = slots.rbegin(); slot != slots.rend(); ++slot)
  {
    if (slot->isUsed.load(std::memory_order_acquire) && unlink(slot->path.data()) != 0)
    {
      rmdir(slot->path.data());
    }
  }
  raise(signal); // delivered at the end of this function, with the default action
}

void
InstallHandlers()
{
  for (const int signal :
       { SIGHUP, SIGINT, SIGQUIT, SIGPIPE, SIGTERM, SIGXCPU, SIGXFSZ, SIGABRT, SIGBUS, SIGSEGV, SIGFPE, SIGILL })
  {
    struct sigaction action = {};
    if (sigaction(signal, nullptr, &action) == 0 && (action.sa_flags & SA_SIGINFO) == 0 && action.sa_handler == SIG_DFL)
    {
      action.sa_handler = RemoveAndEnd;
      action.sa_flags = static_cast<int>(SA_RESETHAND);
      sigfillset(&action.sa_mask);
      sigaction(signal, &action, nullptr);
    }
  }
}
} // namespace

SignalCleanup::SignalCleanup(const std::string & path)
{
  [[maybe_unused]] static const bool installed = (InstallHandlers(), true);
  const auto free = std::find_if(slots.begin(), slots.end(), [](const Slot & slot) { return !slot.isUsed.load(); });
  if (free == slots.end() || path.size() >= free->path.size())
  {
    throw std::runtime_error("cannot write " + path + ": its name is too long, or too many files are being written");
  }
  std::copy(path.c_str(), path.c_str() + path.size() + 1, free->path.begin());
  free->isUsed.store(true, std::memory_order_release);
  m_Slot = static_cast<std::size_t>(free - slots.begin());
}

SignalCleanup::~SignalCleanup()
{
  slots[m_Slot].isUsed.store(false);
}

} // namespace sensornoise::tools
