// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "files/PhotronHeader.h"

#include "sensornoise/FrameFile.h"

#include <cstddef>
#include <sstream>
#include <vector>

namespace sensornoise
{
namespace
{
constexpr std::size_t MaximumHeader = std::size_t{ 4 } << 20;
constexpr std::size_t MaximumDepth = 64;

/** Without the blanks and ends of lines around it. */
std::string
Trimmed(const std::string & text)
{
  const char * const blanks = " \t\r\n";
  const std::size_t  first = text.find_first_not_of(blanks);
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

/** What comes twice and is not the same, as elements of a list do, is no value that anything could be made of. */
void
AddField(std::map<std::string, std::string> & fields, const std::string & name, const std::string & value)
{
  const auto added = fields.emplace(name, value);
  if (!added.second && added.first->second != value)
  {
    added.first->second = "two values";
  }
}

/** Reads the elements of a text of XML: no more of it than such headers have. */
class PhotronElements
{
public:
  PhotronElements(const std::string & file, const std::string & text)
    : m_File(file)
    , m_Text(text)
  {}

  std::map<std::string, std::string>
  Read()
  {
    m_At = m_Text.find("<cih>");
    if (m_At == std::string::npos)
    {
      Refuse("has no element <cih>");
    }
    m_At += 5;
    while (!m_IsDone)
    {
      const std::size_t tag = m_Text.find('<', m_At);
      const std::size_t end = tag == std::string::npos ? tag : EndOfTag(tag);
      if (end == std::string::npos)
      {
        Refuse("ends within its elements");
      }
      m_Content += m_Text.substr(m_At, tag - m_At);
      m_At = end + 1;
      ReadTag(m_Text.substr(tag + 1, end - tag - 1));
    }
    return m_Fields;
  }

private:
  [[noreturn]] void
  Refuse(const std::string & what) const
  {
    throw FileError(m_File, "damaged: " + what + "; expected a header of a Photron camera, <cih> to </cih>");
  }

  std::size_t
  EndOfTag(std::size_t tag) const
  {
    if (m_Text.compare(tag, 4, "<!--") == 0)
    {
      const std::size_t end = m_Text.find("-->", tag + 4);
      return end == std::string::npos ? end : end + 2;
    }
    return m_Text.find('>', tag);
  }

  void
  ReadTag(const std::string & tag)
  {
    if (tag.empty() || tag[0] == '!' || tag[0] == '?')
    {
      return; // comments, declarations
    }
    if (tag[0] == '/')
    {
      Close(Trimmed(tag.substr(1)));
      return;
    }
    const std::string name = tag.substr(0, tag.find_first_of(" \t\r\n/"));
    if (name.empty() || m_Path.size() == MaximumDepth)
    {
      Refuse("its elements have no names, or lie " + std::to_string(MaximumDepth) + " deep");
    }
    m_Path.push_back(name);
    m_Content.clear();
    m_IsLeaf = true;
    if (tag.back() == '/')
    {
      Close(name);
    }
  }

  void
  Close(const std::string & name)
  {
    if (m_Path.empty() && name == "cih")
    {
      m_IsDone = true;
      return;
    }
    if (m_Path.empty() || m_Path.back() != name)
    {
      Refuse("</" + name + "> where </" + (m_Path.empty() ? "cih" : m_Path.back()) + "> has to be");
    }
    if (m_IsLeaf)
    {
      std::string path;
      for (const std::string & part : m_Path)
      {
        path += (path.empty() ? "" : "/") + part;
      }
      AddField(m_Fields, path, Trimmed(m_Content));
    }
    m_Path.pop_back();
    m_Content.clear();
    m_IsLeaf = false;
  }

  const std::string &                m_File;
  const std::string &                m_Text;
  std::size_t                        m_At{ 0 };
  std::vector<std::string>           m_Path{};
  std::string                        m_Content{};
  bool                               m_IsLeaf{ false };
  bool                               m_IsDone{ false };
  std::map<std::string, std::string> m_Fields{};
};

/** Lines "Name : value", up to one that is empty. */
std::map<std::string, std::string>
ReadLines(const std::string & text)
{
  std::map<std::string, std::string> fields;
  std::istringstream                 lines(text);
  for (std::string line; std::getline(lines, line);)
  {
    const std::size_t separator = line.find(':');
    if (Trimmed(line).empty() || separator == std::string::npos)
    {
      continue;
    }
    AddField(fields, Trimmed(line.substr(0, separator)), Trimmed(line.substr(separator + 1)));
  }
  return fields;
}
} // namespace

std::map<std::string, std::string>
ReadPhotronHeader(const std::string & file, FileBytes & bytes)
{
  if (bytes.Size() > MaximumHeader)
  {
    throw FileError(file,
                    "its header has " + std::to_string(bytes.Size()) + " bytes; expected at most " +
                      std::to_string(MaximumHeader));
  }
  std::string text(static_cast<std::size_t>(bytes.Size()), '\0');
  bytes.Read(0, text.data(), text.size());
  // an XML file begins with its declaration, whatever stands before
  const bool isXml = text.find("<?xml") != std::string::npos || text.find("<cih>") != std::string::npos;
  return isXml ? PhotronElements(file, text).Read() : ReadLines(text);
}

} // namespace sensornoise
