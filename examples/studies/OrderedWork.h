// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef OrderedWork_h
#define OrderedWork_h

#include <cstddef>
#include <functional>
#include <string>

namespace sensornoise::tools
{

/** Calls \a make for 0 to \a count - 1 on \a threads threads, and passes each result to \a use after all earlier
 * results. The order of the results does not depend on the number of threads. Throws the first exception of \a make
 * or \a use. No further result is used after an exception. */
void
MakeInOrder(std::size_t                                      count,
            unsigned int                                     threads,
            const std::function<std::string(std::size_t)> &  make,
            const std::function<void(const std::string &)> & use);

} // namespace sensornoise::tools

#endif
