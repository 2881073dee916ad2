// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_PngData_h
#define sensornoise_page_PngData_h

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sensornoise
{

/** An image whose pixels are places in a palette of red, green and blue, as a PNG in a "data:" address. Throws
 * std::invalid_argument if there are not width x height pixels, or no or more than 256 colours. */
std::string
PngAsDataAddress(std::size_t                                      width,
                 std::size_t                                      height,
                 const std::vector<std::uint8_t> &                pixels,
                 const std::vector<std::array<std::uint8_t, 3>> & palette);

} // namespace sensornoise

#endif
