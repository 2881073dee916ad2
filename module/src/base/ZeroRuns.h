// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_base_ZeroRuns_h
#define sensornoise_base_ZeroRuns_h

#include "SensorNoiseExport.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <streambuf>
#include <vector>

/** \file
 * Compression of bytes with long runs of zeros. Sums that are kept frame by frame are 0 where a frame was not added: a
 * process that has read few of many frames sends only a small part of them. */

namespace sensornoise
{

/** \class ZeroRunWriter
 * \brief Packs bytes: blocks of 64 bytes that are all 0 are counted, the others kept.
 *
 * The packed data are a list of runs. Each run has two counts of 8 bytes, of the zero blocks and of the kept blocks
 * that follow, and then the kept blocks. The rate is about 5 GB/s. */
class SensorNoise_EXPORT ZeroRunWriter : public std::streambuf
{
public:
  static constexpr std::size_t BlockBytes = 64;

  /** Returns the packed bytes that were written; the last block is filled up with zeros. The writer is then empty. */
  std::vector<unsigned char>
  Take();

protected:
  std::streamsize
  xsputn(const char * bytes, std::streamsize count) override;
  int_type
  overflow(int_type character) override;

private:
  void
  TakeBlock(const unsigned char * block);
  /** Writes the counts of the current run to their place. */
  void
  EndRun();

  std::vector<unsigned char>            m_Packed;
  std::array<unsigned char, BlockBytes> m_Block{}; // block that is not full
  std::size_t                           m_InBlock{ 0 };
  std::size_t                           m_Place{ 0 }; // place of the counts of the current run
  std::uint64_t                         m_Zeros{ 0 };
  std::uint64_t                         m_Kept{ 0 };
};

/** \class ZeroRunReader
 * \brief Unpacks the bytes of a ZeroRunWriter. Invalid packed bytes end early, without a memory error. */
class SensorNoise_EXPORT ZeroRunReader : public std::streambuf
{
public:
  /** \a packed must outlive the reader. */
  ZeroRunReader(const unsigned char * packed, std::size_t bytes);

protected:
  std::streamsize
  xsgetn(char * bytes, std::streamsize count) override;
  int_type
  underflow() override;
  int_type
  uflow() override;

private:
  /** Moves to the next run that is not empty. Returns false at the end. */
  bool
  FindRun();

  const unsigned char * m_Packed;
  const unsigned char * m_End;
  std::uint64_t         m_Zeros{ 0 }; // bytes that are left of the run
  std::uint64_t         m_Kept{ 0 };
};

} // namespace sensornoise

#endif
