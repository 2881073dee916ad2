// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/TextHeader.h"

#include "base/Text.h"
#include "files/FrameReader.h"
#include "sensornoise/FrameFile.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdlib>

namespace sensornoise
{

namespace
{
constexpr std::uint64_t MaximumHeaderBytes = 4 << 20;
constexpr std::size_t   MaximumHeaderLines = 100000;
constexpr std::size_t   MaximumLineBytes = 4096;
constexpr const char *  Blanks = " \t";

bool
IsText(int c)
{
  return c == '\t' || (c >= ' ' && c != 0x7F);
}
} // namespace

TextHeader::TextHeader(const std::string & file, FileBytes & bytes)
  : m_File(file)
  , m_Reader(bytes, 0, bytes.Size())
{}

std::optional<std::string>
TextHeader::Next()
{
  std::string line;
  int         c = m_Reader.Next();
  if (c < 0)
  {
    return std::nullopt;
  }
  ++m_Line;
  const std::string place = "line " + std::to_string(m_Line) + " of its header ";
  for (; c >= 0 && c != '\n'; c = m_Reader.Next())
  {
    if (!line.empty() && line.back() == '\r')
    {
      throw FileError(m_File, place + "has a carriage return within it; expected text");
    }
    if (c != '\r' && !IsText(c))
    {
      throw FileError(m_File, place + "has the character of code " + std::to_string(c) + "; expected text");
    }
    if (line.size() >= MaximumLineBytes)
    {
      throw FileError(m_File,
                      place + "has more than " + std::to_string(MaximumLineBytes) + " characters; expected fewer");
    }
    line += static_cast<char>(c);
  }
  m_Ended = c == '\n';
  if (!line.empty() && line.back() == '\r')
  {
    line.pop_back();
  }
  if (m_Reader.Offset() > MaximumHeaderBytes || m_Line > MaximumHeaderLines)
  {
    throw FileError(m_File,
                    "its header has more than " + std::to_string(MaximumHeaderLines) +
                      " lines, or more than 4 MiB; expected a MetaImage or NRRD file");
  }
  return line;
}

std::string
WithoutBlanks(const std::string & text)
{
  const std::size_t first = text.find_first_not_of(Blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(Blanks) - first + 1);
}

std::string
PrintableText(const std::string & text)
{
  constexpr std::size_t longest = 100;
  std::string           printable;
  for (const char c : text)
  {
    printable += c >= ' ' && c < 127 && printable.size() < longest ? std::string(1, c) : "";
  }
  return WithoutBlanks(printable);
}

std::vector<std::string>
WordsOf(const std::string & text)
{
  std::vector<std::string> words;
  for (std::size_t at = text.find_first_not_of(Blanks); at != std::string::npos;)
  {
    const std::size_t end = text.find_first_of(Blanks, at);
    words.push_back(text.substr(at, end - at));
    at = text.find_first_not_of(Blanks, end);
  }
  return words;
}

std::optional<std::uint64_t>
WholeNumber(const std::string & text)
{
  if (text.empty() || text.size() > 18 || text.find_first_not_of("0123456789") != std::string::npos)
  {
    return std::nullopt;
  }
  return std::strtoull(text.c_str(), nullptr, 10);
}

std::vector<double>
NumbersOf(const std::string & text)
{
  std::vector<double> numbers;
  for (const std::string & word : WordsOf(text))
  {
    const std::optional<double> number = FiniteNumber(word);
    if (!number)
    {
      return {};
    }
    numbers.push_back(*number);
  }
  return numbers;
}

namespace
{
constexpr std::uint64_t FitsBlockBytes = 2880;
constexpr std::size_t   FitsCardBytes = 80;
constexpr std::size_t   MostFitsCards = 36000; // cards in 1000 blocks
constexpr std::int64_t  MostFitsAxes = 999;    // FITS standard, 4.4.1

/** Returns the value of a card, without quotation marks, comment and spaces around it. */
std::string
ValueOfCard(const std::string & card)
{
  const std::string field = card.substr(10);
  const std::size_t quote = field.find_first_not_of(' ');
  if (quote == std::string::npos || field[quote] != '\'')
  {
    return WithoutBlanks(field.substr(0, field.find('/')));
  }
  std::string text;
  for (std::size_t i = quote + 1; i < field.size(); ++i)
  {
    if (field[i] == '\'')
    {
      if (i + 1 == field.size() || field[i + 1] != '\'')
      {
        break;
      }
      ++i; // two quotation marks mean one
    }
    text += field[i];
  }
  return WithoutBlanks(text);
}

/** Returns whether the pixels depend on the value of the keyword. */
bool
DecidesPixels(const std::string & key)
{
  static constexpr std::array<const char *, 10> keys{
    { "SIMPLE", "XTENSION", "BITPIX", "PCOUNT", "GCOUNT", "BSCALE", "BZERO", "BLANK", "ZIMAGE", "DATASUM" }
  };
  return key.rfind("NAXIS", 0) == 0 || std::find(keys.begin(), keys.end(), key) != keys.end();
}

/** Reads the cards up to END into header.values. Returns the offset of the data [bytes]. Throws FileError. */
std::uint64_t
ReadCards(FileBytes & bytes, std::uint64_t offset, FitsHeader & header)
{
  for (std::size_t number = 0; number < MostFitsCards; ++number)
  {
    const std::uint64_t at = offset + number * FitsCardBytes;
    if (!bytes.Holds(at, FitsCardBytes))
    {
      throw FileError(header.name,
                      "truncated: the file ends within a header, after " + std::to_string(bytes.Size()) +
                        " bytes; expected the keyword END");
    }
    std::string card(FitsCardBytes, '\0');
    bytes.Read(at, card.data(), card.size());
    if (std::any_of(card.begin(), card.end(), [](char c) { return c < ' ' || c > '~'; }))
    {
      throw FileError(header.name,
                      "damaged: card " + std::to_string(number) + " of its header is no text of ASCII; expected that");
    }
    const std::string key = WithoutBlanks(card.substr(0, 8));
    if (key == "END" && WithoutBlanks(card) == "END")
    {
      const std::uint64_t end = (number + 1) * FitsCardBytes;
      return offset + (end + FitsBlockBytes - 1) / FitsBlockBytes * FitsBlockBytes;
    }
    const bool hasValue = card.compare(8, 2, "= ") == 0;
    const bool isNew = !hasValue || header.values.emplace(key, ValueOfCard(card)).second;
    if (!isNew && DecidesPixels(key)) // programs repeat other keywords
    {
      throw FileError(header.name, "damaged: the keyword " + key + " comes twice; expected each once");
    }
  }
  throw FileError(header.name,
                  "damaged: a header of more than " + std::to_string(MostFitsCards) + " cards; expected fewer");
}

std::int64_t
RequiredInteger(const FitsHeader & header, const std::string & key)
{
  const std::optional<std::int64_t> number = header.Integer(key);
  if (!number)
  {
    throw FileError(header.name, "damaged: has no keyword " + key + "; expected one");
  }
  return *number;
}

/** Returns the size of the data [bytes] from axes, BITPIX, PCOUNT and GCOUNT; 0 without axes. Throws FileError. */
std::uint64_t
DataBytesOf(const FitsHeader & header)
{
  const std::int64_t groups = header.Integer("GCOUNT").value_or(1);
  const std::int64_t parameters = header.Integer("PCOUNT").value_or(0);
  if (groups < 1 || parameters < 0)
  {
    throw FileError(header.name,
                    "damaged: GCOUNT is " + std::to_string(groups) + " and PCOUNT " + std::to_string(parameters) +
                      "; expected at least 1 and 0");
  }
  if (header.axes.empty())
  {
    return 0;
  }
  std::optional<std::uint64_t> elements = 1;
  for (const std::uint64_t axis : header.axes)
  {
    elements = elements ? CheckedProduct(*elements, axis) : elements;
  }
  const auto extra = static_cast<std::uint64_t>(parameters);
  if (elements && *elements <= INT64_MAX - extra)
  {
    elements = CheckedProduct(*elements + extra, static_cast<std::uint64_t>(groups));
    elements =
      elements ? CheckedProduct(*elements, static_cast<std::uint64_t>(std::abs(header.bitsOfPixel)) / 8) : elements;
    if (elements)
    {
      return *elements;
    }
  }
  throw FileError(header.name, "more data than can be counted in bytes; expected a smaller image");
}
} // namespace

std::string
FitsHeader::Text(const std::string & key) const
{
  const auto found = values.find(key);
  return found == values.end() ? "" : found->second;
}

std::optional<double>
FitsHeader::Number(const std::string & key) const
{
  if (values.count(key) == 0)
  {
    return std::nullopt;
  }
  const std::optional<double> number = FortranNumber(this->Text(key));
  if (!number)
  {
    throw FileError(name, "damaged: its keyword " + key + " is \"" + this->Text(key) + "\"; expected a number");
  }
  return number;
}

std::optional<std::int64_t>
FitsHeader::Integer(const std::string & key) const
{
  if (values.count(key) == 0)
  {
    return std::nullopt;
  }
  const std::string                  text = this->Text(key);
  const bool                         isNegative = text.rfind('-', 0) == 0;
  const bool                         hasSign = isNegative || text.rfind('+', 0) == 0;
  const std::optional<std::uint64_t> digits = WholeNumber(text.substr(hasSign ? 1 : 0));
  if (!digits)
  {
    throw FileError(name, "damaged: its keyword " + key + " is \"" + text + "\"; expected a whole number");
  }
  return isNegative ? -static_cast<std::int64_t>(*digits) : static_cast<std::int64_t>(*digits);
}

FitsHeader
ReadFitsHeader(const std::string & name, FileBytes & bytes, std::uint64_t offset)
{
  FitsHeader header;
  header.name = name;
  header.dataBegin = ReadCards(bytes, offset, header);
  if (header.Text("GROUPS") == "T")
  {
    throw FileError(name, "holds random groups, which are no image; expected an image of two or three axes");
  }
  header.bitsOfPixel = RequiredInteger(header, "BITPIX");
  const std::int64_t axes = RequiredInteger(header, "NAXIS");
  if (axes < 0 || axes > MostFitsAxes)
  {
    throw FileError(name, "damaged: NAXIS is " + std::to_string(axes) + "; expected 0 to 999");
  }
  for (std::int64_t axis = 1; axis <= axes; ++axis)
  {
    const std::int64_t size = RequiredInteger(header, "NAXIS" + std::to_string(axis));
    if (size < 0)
    {
      throw FileError(
        name, "damaged: NAXIS" + std::to_string(axis) + " is " + std::to_string(size) + "; expected at least 0");
    }
    header.axes.push_back(static_cast<std::uint64_t>(size));
  }
  for (const std::int64_t known : { 8, 16, 32, 64, -32, -64 })
  {
    if (header.bitsOfPixel == known)
    {
      header.dataBytes = DataBytesOf(header);
      if (!bytes.Holds(header.dataBegin, header.dataBytes) && header.dataBytes > 0)
      {
        throw FileError(name,
                        "truncated: its data have " + std::to_string(header.dataBytes) + " bytes from byte " +
                          std::to_string(header.dataBegin) + " on, but the file has " + std::to_string(bytes.Size()));
      }
      header.next = header.dataBegin + (header.dataBytes + FitsBlockBytes - 1) / FitsBlockBytes * FitsBlockBytes;
      if (header.next > bytes.Size()) // with an incomplete last block, bytes may be missing anywhere before
      {
        throw FileError(name,
                        "truncated: its last block ends at byte " + std::to_string(header.next) +
                          ", but the file has " + std::to_string(bytes.Size()) + "; expected whole blocks of " +
                          std::to_string(FitsBlockBytes) + " bytes");
      }
      return header;
    }
  }
  throw FileError(name,
                  "damaged: BITPIX is " + std::to_string(header.bitsOfPixel) + "; expected 8, 16, 32, 64, -32 or -64");
}

} // namespace sensornoise
