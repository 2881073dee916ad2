// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "studies/OrderedWork.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <vector>

namespace sensornoise::tools
{

namespace
{
/** Queue of results that wait until all earlier results were used. */
class Queue
{
public:
  explicit Queue(const std::function<void(const std::string &)> & use)
    : m_Use(use)
  {}

  void
  Add(std::size_t place, const std::string & result)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Waiting.emplace(place, result);
    for (auto next = m_Waiting.find(m_Used); next != m_Waiting.end() && !m_Error; next = m_Waiting.find(m_Used))
    {
      m_Use(next->second);
      m_Waiting.erase(next);
      ++m_Used;
    }
  }
  void
  Fail(const std::exception_ptr & error)
  {
    const std::lock_guard<std::mutex> lock(m_Mutex);
    m_Error = m_Error ? m_Error : error;
  }
  void
  RethrowError() const
  {
    if (m_Error)
    {
      std::rethrow_exception(m_Error);
    }
  }

private:
  std::function<void(const std::string &)> m_Use;
  std::mutex                               m_Mutex;
  std::map<std::size_t, std::string>       m_Waiting;
  std::size_t                              m_Used{ 0 };
  std::exception_ptr                       m_Error;
};
} // namespace

void
MakeInOrder(std::size_t                                      count,
            unsigned int                                     threads,
            const std::function<std::string(std::size_t)> &  make,
            const std::function<void(const std::string &)> & use)
{
  Queue                    queue(use);
  std::atomic<std::size_t> next{ 0 };
  const auto               work = [&] {
    for (std::size_t k = next++; k < count; k = next++)
    {
      try
      {
        queue.Add(k, make(k));
      }
      catch (...)
      {
        queue.Fail(std::current_exception());
        next = count;
      }
    }
  };
  std::vector<std::thread> workers;
  for (unsigned int i = 0; i < std::max(1U, threads); ++i)
  {
    workers.emplace_back(work);
  }
  for (std::thread & worker : workers)
  {
    worker.join();
  }
  queue.RethrowError();
}

} // namespace sensornoise::tools
