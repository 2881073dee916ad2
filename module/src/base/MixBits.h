// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_MixBits_h
#define sensornoise_base_MixBits_h

#include <cstdint>

namespace sensornoise
{

/** Scrambles 64 bits one to one (finaliser of SplitMix64: Steele, Lea and Flood, OOPSLA 2014,
 * DOI 10.1145/2660193.2660195). */
inline std::uint64_t
MixBits(std::uint64_t bits)
{
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31);
}

} // namespace sensornoise

#endif
