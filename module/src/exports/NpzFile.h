// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_NpzFile_h
#define sensornoise_exports_NpzFile_h

#include <cstddef>
#include <string>
#include <vector>

namespace sensornoise
{

/** An array of double for a NumPy archive; the last index runs fastest. */
struct NpzArray
{
  std::string              name;
  std::vector<std::size_t> shape; ///< empty: one number
  std::vector<double>      values;
};

/** The bytes of a NumPy archive (.npz): a ZIP file whose members are not compressed, NPY files of version 1.0. */
std::string
NpzFile(const std::vector<NpzArray> & arrays);

} // namespace sensornoise

#endif
