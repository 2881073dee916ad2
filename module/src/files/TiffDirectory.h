// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_TiffDirectory_h
#define sensornoise_files_TiffDirectory_h

#include "files/FileBytes.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** Entry of the directory of a TIFF: type, number and place of its values. */
struct TiffEntry
{
  unsigned      tag{ 0 };
  unsigned      type{ 0 };
  std::uint64_t count{ 0 };
  std::uint64_t offset{ 0 };     // offset of the first value in the file [bytes]
  bool          inside{ false }; // the values are in the directory itself
};

/** The directory of a page. */
struct TiffDirectory
{
  std::uint64_t          offset{ 0 };
  std::uint64_t          bytes{ 0 }; // with the number of entries and the offset of the next directory
  std::uint64_t          next{ 0 };  // offset of the next directory; 0: this is the last
  std::vector<TiffEntry> entries{};

  /** Returns the entry of the tag; null: the directory has none. */
  const TiffEntry *
  Find(unsigned tag) const;
};

/** Returns the size of a value of the type [bytes]; 0: TIFF has no such type. */
std::size_t
SizeOfTiffType(unsigned type);

/** Reads a TIFF in its own byte order, classic or big. */
class TiffBytes
{
public:
  /** Reads the head of a file that begins like a TIFF (IsTiff()). Throws FileError if the file ends or is damaged right
   * after that. */
  TiffBytes(const std::string & file, FileBytes & bytes);

  /** Returns whether the file begins like a TIFF, of any byte order and size. */
  static bool
  IsTiff(const unsigned char * head, std::size_t count);

  /** Returns the offset of the directory of the first page [bytes]. */
  std::uint64_t
  FirstDirectory() const
  {
    return m_First;
  }

  /** Size of the head of the file [bytes]. */
  std::uint64_t
  HeadBytes() const
  {
    return m_IsBig ? 16 : 8;
  }

  /** Reads a directory; \a page begins the errors. Throws FileError if a part of it, or a value of its entries, is
   * not in the file. */
  TiffDirectory
  ReadDirectory(const std::string & page, std::uint64_t offset);

  /** The only value of an entry; nothing where there is no such entry. Throws FileError unless it is a whole number and
   * the only one. */
  std::optional<std::uint64_t>
  Number(const std::string & page, const TiffDirectory & directory, unsigned tag, const char * name);

  /** Returns whether what could be the entry of a directory, of a whole number, is among these bytes. */
  bool
  HasEntry(std::uint64_t begin, std::uint64_t end, unsigned tag, std::uint64_t value);

  /** The only value of an entry that is a quotient of two whole numbers; 0 where there is none, or no such one. */
  double
  Quotient(const TiffDirectory & directory, unsigned tag);

  bool
  IsBigEndian() const
  {
    return m_IsBigEndian;
  }

  FileBytes &
  File()
  {
    return m_Bytes;
  }

  /** Reads the values of an entry, one after the other. */
  class Numbers
  {
  public:
    Numbers(TiffBytes & tiff, const TiffEntry & entry);

    std::uint64_t
    Next();

  private:
    ByteReader  m_Reader;
    std::size_t m_Width;
    bool        m_IsBigEndian;
  };

private:
  std::uint64_t
  At(const unsigned char * bytes, std::size_t width) const;

  void
  CheckEntry(const std::string & page, const TiffEntry & entry) const;

  FileBytes &   m_Bytes;
  bool          m_IsBig{ false };
  bool          m_IsBigEndian{ false };
  std::uint64_t m_First{ 0 };
};

/** The tags of one directory of a TIFF. */
class TiffTags
{
public:
  /** Errors begin with \a page. All three arguments must outlive the object. */
  TiffTags(const std::string & page, TiffBytes & tiff, const TiffDirectory & directory)
    : m_Page(page)
    , m_Tiff(tiff)
    , m_Directory(directory)
  {}

  bool
  Has(unsigned tag) const
  {
    return m_Directory.Find(tag) != nullptr;
  }

  /** The only value of a tag, or \a otherwise where there is no such tag. Throws FileError unless it is one whole
   * number. */
  std::uint64_t
  Number(unsigned tag, const char * name, std::uint64_t otherwise) const;

  /** The only value of a tag that must be there. Throws FileError. */
  std::uint64_t
  Required(unsigned tag, const char * name) const;

  /** The entry of a tag that has \a count numbers, one for each \a piece of the image ("strip"). Throws FileError. */
  TiffEntry
  EntryOfEach(unsigned tag, const char * name, std::uint64_t count, const char * piece) const;

  /** Throws FileError if a tag comes twice: programs take one or the other. */
  void
  RequireEachOnce() const;

  /** Throws FileError. */
  [[noreturn]] void
  Refuse(const std::string & what) const;

private:
  const std::string &   m_Page;
  TiffBytes &           m_Tiff;
  const TiffDirectory & m_Directory;
};

} // namespace sensornoise

#endif
