// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_files_FrameFormats_h
#define sensornoise_files_FrameFormats_h

#include "SensorNoiseExport.h"
#include "files/FileBytes.h"
#include "files/FrameReader.h"
#include "sensornoise/FrameFile.h"
#include "sensornoise/Settings.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace sensornoise
{

/** Format that is read: a line of the table in FrameFile.cxx. Only the table, the functions below and the files of the
 * format depend on it. */
struct FrameFormat
{
  const char * name{ nullptr };       ///< name in sentences
  bool         hasITKReader{ false }; ///< ITK's own class reads it, to which itk::ImageFileReader is left

  /** Returns whether a file is of this format, by its first bytes, 512 or all, and otherwise by its name. */
  bool (*isItsHead)(const std::string & head, const std::string & name){ nullptr };

  /** Fills in all of \a file but its name, format and first identity, and sets its reader, or throws FileError, see
   * InspectFrameFile(). */
  void (*inspect)(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating){ nullptr };

  /** The paths of the other files that hold a part of this file; null: all is in one file. */
  std::vector<std::string> (*dataFiles)(FileBytes & bytes, const std::string & name){ nullptr };
};

/** Returns all formats. A file has the first format that accepts its head. */
SensorNoise_EXPORT const std::vector<FrameFormat> &
FrameFormats();

/** The first bytes of a file, 512 or all. */
SensorNoise_EXPORT std::string
HeadOf(FileBytes & bytes);

/** The format of a file that begins with \a head; null: none of them. */
SensorNoise_EXPORT const FrameFormat *
FindFrameFormat(const std::string & head, const std::string & name);

/** Returns the paths of the other files that hold the pixels, or the header, of a file. They need not exist. The result
 * is empty for a file that cannot be read. */
SensorNoise_EXPORT std::vector<std::string>
DataFilesOf(const std::string & name);

/** Returns whether a file's name ends in one of \a endings, each with its dot and in small letters. The name may have
 * capitals. */
bool
HasEnding(const std::string & name, std::initializer_list<const char *> endings);

/** Returns the formats that are expected of a file: "TIFF, PNG, MetaImage or NRRD". */
SensorNoise_EXPORT std::string
NamesOfFrameFormats();

// The functions of each format, in the order of the table; their bodies are in <Name>File.cxx.

/** Returns whether a file is a raw file of a camera: DNG, CR2, CR3, NEF, ARW, RAF, ORF, RW2 and others. Most of them
 * begin as a TIFF does: then its first directory and those below are read for the version of DNG or for the colours of
 * a mosaic, and the ending of the name decides if the file has neither. */
bool
IsHeadOfRawCamera(const std::string & head, const std::string & name);

/** Returns whether this build reads raw files of cameras: SensorNoise_USE_LibRaw. */
SensorNoise_EXPORT bool
ReadsRawCameraFiles();

/** Fills in the properties that the raw file of a camera states, by LibRaw, and all of `FrameFile::camera`. \a file has
 * its name and identity. A frame has the digital numbers of the visible area as they are in the file, without black
 * level, white balance or colours: unsigned short, one a pixel. All of them are decoded for the check, and not kept.
 *
 * Throws FileError without LibRaw, for a file that LibRaw cannot read, which ends before its pixels do or whose decoder
 * meets an error, for several colours a pixel, several frames, and what is known to be compressed with loss. For a DNG,
 * RequireWholeRawTiff() also compares its directory, its strips or tiles, and LibRaw. */
void
InspectRawCamera(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file begins as a TIFF, or a BigTIFF, of either byte order. */
bool
IsHeadOfTiff(const std::string & head, const std::string & name);

/** Fills in the properties that a TIFF, or a BigTIFF, states. \a file has its name and identity. Throws FileError
 * unless its pages are all there, of one size and kind, and TiffStrips has nothing against them. */
void
InspectTiff(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file begins as a PNG. */
bool
IsHeadOfPng(const std::string & head, const std::string & name);

/** Fills in the description of a PNG file. \a file has its name and identity. Throws FileError unless all of its
 * chunks are there, in the right order and with the right checksums, and its pixels are grey values of 8 or 16 bits
 * that inflate to exactly as many as it declares. */
void
InspectPng(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file may be a MetaImage, which has no mark of its own: its name ends as one, and fields begin. */
bool
IsHeadOfMetaImage(const std::string & head, const std::string & name);

/** Fills in the description of a MetaImage. \a file has its name and identity. Throws FileError unless all of its
 * pixels are there, in the file or in data files. */
void
InspectMetaImage(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns the paths of the files that hold its pixels. Throws FileError if the header cannot be read. */
std::vector<std::string>
DataFilesOfMetaImage(FileBytes & bytes, const std::string & name);

/** Returns whether a file begins as a NRRD file, whatever its name. */
bool
IsHeadOfNrrd(const std::string & head, const std::string & name);

/** Fills in the description of a NRRD file. \a file has its name and identity. Throws FileError unless all of its
 * pixels are there, raw or in a complete gzip stream, in the file or in data files. */
void
InspectNrrd(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns the paths of the files that hold its pixels. Throws FileError if the header cannot be read. */
std::vector<std::string>
DataFilesOfNrrd(FileBytes & bytes, const std::string & name);

/** Returns whether a file begins as a SER file, a format of astronomical recordings. */
bool
IsHeadOfSer(const std::string & head, const std::string & name);

/** Fills in the description of a SER file: "SER format description version 3" of G. Hahn, 2014. \a file has its name
 * and identity. Throws FileError unless it holds exactly the frames that it declares, with or without a time for each,
 * and of one value a pixel. A file may declare 0 frames, because the program that wrote it did not close it. Then all
 * whole frames are read, and FrameFile::warning says so.
 *
 * The first programs wrote another order of the bytes than the description has, so that both exist today. The order of
 * the programs is assumed (LittleEndian 0: lowest byte first), unless neighbours in the first frame differ much less in
 * the other order. */
void
InspectSer(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file is one of the two of a recording of a Photron camera, which have no mark of their own: by its
 * name, .mraw, or .cihx or .cih. */
bool
IsHeadOfMraw(const std::string & head, const std::string & name);

/** Fills in the description of a recording of a Photron camera: the pixels in a .mraw file, their size and number in a
 * .cihx or .cih file of the same name beside it. \a file is either of them, with its name and identity. Throws
 * FileError unless both exist, and the pixels are exactly the pixels in the header. */
void
InspectMraw(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns the path of the other file of a recording. Throws FileError if it is missing. */
std::vector<std::string>
DataFilesOfMraw(FileBytes & bytes, const std::string & name);

/** Returns whether a file begins as FITS does. */
SensorNoise_EXPORT bool
IsHeadOfFits(const std::string & head, const std::string & name);

/** Reads the headers of all units of a FITS file. Exactly one of them must be an image: a frame has two axes, a stack
 * three.
 *
 * Integers with the BZERO of unsigned ones are read as these. Where BSCALE, BZERO or BLANK say something else, values
 * are read as double: BZERO + BSCALE times the number, NaN for BLANK. Rows are read in the order of the file. Throws
 * FileError for compressed images, for several images, for integers of 64 bits, and where DATASUM does not fit the
 * data. FITS standard, version 4. */
SensorNoise_EXPORT void
InspectFits(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file begins like the files of numpy.save(). */
SensorNoise_EXPORT bool
IsHeadOfNpy(const std::string & head, const std::string & name);

/** Reads the header of a NPY file, versions 1 to 3: an array of two axes (rows, columns) is a frame, one of three
 * (frames, rows, columns) a stack. Throws FileError unless its bytes are exactly the pixels that it declares, in C
 * order and of a type that StoredNumber or FramePixel has. numpy.lib.format describes the format. */
SensorNoise_EXPORT void
InspectNpy(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Returns whether a file begins as Netpbm's formats do: PBM, PGM, PPM. */
SensorNoise_EXPORT bool
IsHeadOfPnm(const std::string & head, const std::string & name);

/** Reads the headers of a binary PGM file (P5, 8 or 16 bits). It may have several images, one after the other: frames.
 * Throws FileError unless all images are complete and have the same size and maximum, and for colours, text and
 * bitmaps. A maximum of 2^n - 1 means n bits of the camera. */
SensorNoise_EXPORT void
InspectPnm(FileBytes & bytes, FrameFile & file, const BeforeInflating & beforeInflating);

/** Layout of the frames in a file without a header, for example in a dump of a camera's memory. */
struct RawLayout
{
  std::uint64_t  width{ 0 };  // [pixel]
  std::uint64_t  height{ 0 }; // [pixel]
  SampleFormat   sample{};
  std::uint64_t  skipBytes{ 0 }; // bytes before the first frame
  std::uint64_t  rowBytes{ 0 };  // bytes from a row to the next; 0: no gap between rows
  std::uint64_t  gapBytes{ 0 };  // bytes behind each frame
  std::uint64_t  endBytes{ 0 };  // bytes at the end of the file
  CameraSettings camera{};       // Bayer pattern and bit depth, if the name of the type gives them
};

/** Returns the layout "WIDTHxHEIGHT:TYPE[:SKIP[:ROW[:GAP[:END]]]]". WIDTH and HEIGHT are 1 to 2^31 - 1 pixels. TYPE, in
 * any case, is
 * - uint8, uint16le, uint16be, int16le, int16be, uint32le, uint32be, int32le, int32be, float32le, float32be, float64le
 *   or float64be, with the number of bits and the byte order; integers of 32 bits are read as double;
 * - a name of GenICam: Mono8, Mono10, Mono12, Mono14, Mono16, Mono10p, Mono12p, Mono14p, Mono10Packed, Mono12Packed, or
 *   with a Bayer pattern BayerRG8 and so on;
 * - RAW10, RAW12 or RAW14, packed as in MIPI CSI-2, or with a Bayer pattern SRGGB10P and so on, as in Linux and
 *   libcamera; SRGGB10 and so on are not packed;
 * - uint10msb, uint12msb or uint14msb, a bit stream with the highest bit first.
 *
 * SKIP: bytes before the first frame, default 0. ROW: bytes from a row to the next, default 0: no gap between rows.
 * GAP: bytes behind each frame, default 0; they may be missing behind the last frame. END: bytes at the end of the
 * file, default 0.
 *
 * Throws std::invalid_argument, whose message says what was found and what was expected. */
SensorNoise_EXPORT RawLayout
ReadRawLayout(const std::string & text);

/** Returns the description of a file with this layout, as InspectFrameFile() does for other files. FrameFile::warning
 * is set if its bytes seem swapped. Throws FileError unless the file has a whole number of frames, at least one. */
SensorNoise_EXPORT FrameFile
InspectRawFile(const std::string & name, const RawLayout & layout);

} // namespace sensornoise

#endif
