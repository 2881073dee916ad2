// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
// RELEASE_GIL_DURING(class::method): calls of the method during which other threads of Python run. ITK's wrapping keeps Python's
// global lock (GIL) during every call. One module may include this file: SWIG leaves the text of a file out that an imported
// module has included.
%{
#include "ReleasedGil.h"
%}

// Releases the lock during a method that calls no function of Python and reads no object of Python. The errors are handled
// as in ITK's pyBase.i, when the lock is held again.
%define RELEASE_GIL_DURING(method)
%exception method
{
  try
  {
    const ReleasedGil gil(true);
    $action
  }
  catch (const std::out_of_range & e)
  {
    SWIG_exception_fail(SWIG_IndexError, e.what());
  }
  catch (const std::exception & e)
  {
    SWIG_exception_fail(SWIG_RuntimeError, e.what());
  }
}
%enddef
