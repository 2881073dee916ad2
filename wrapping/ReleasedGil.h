// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef ReleasedGil_h
#define ReleasedGil_h

#include <Python.h>

/** Gives Python's lock to other threads until its end, which an exception brings, too. */
class ReleasedGil
{
public:
  explicit ReleasedGil(bool isReleased)
    : m_State(isReleased ? PyEval_SaveThread() : nullptr)
  {}
  ReleasedGil(const ReleasedGil &) = delete;
  ReleasedGil &
  operator=(const ReleasedGil &) = delete;
  ~ReleasedGil()
  {
    if (m_State != nullptr)
    {
      PyEval_RestoreThread(m_State);
    }
  }

private:
  PyThreadState * m_State;
};

#endif
