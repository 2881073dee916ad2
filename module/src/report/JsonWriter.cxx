// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "report/JsonWriter.h"

#include "base/Text.h"

#include <cmath>
#include <cstdio>

namespace sensornoise
{
void
JsonWriter::Write(double number)
{
  if (!std::isfinite(number))
  {
    m_Text += "null";
    return;
  }
  m_Text += ShortestText(number);
}

void
JsonWriter::Write(std::size_t number)
{
  m_Text += std::to_string(number);
}

void
JsonWriter::Write(int number)
{
  m_Text += std::to_string(number);
}

void
JsonWriter::Write(unsigned int number)
{
  m_Text += std::to_string(number);
}

void
JsonWriter::Write(bool truth)
{
  m_Text += truth ? "true" : "false";
}

void
JsonWriter::Write(const char * string)
{
  this->Write(std::string(string));
}

void
JsonWriter::Write(const std::string & string)
{
  m_Text += '"';
  for (const char c : string)
  {
    if (c == '"' || c == '\\')
    {
      m_Text += '\\';
      m_Text += c;
    }
    else if (static_cast<unsigned char>(c) < 0x20)
    {
      char buffer[8];
      std::snprintf(buffer, sizeof(buffer), "\\u%04x", static_cast<unsigned int>(c));
      m_Text += buffer;
    }
    else
    {
      m_Text += c;
    }
  }
  m_Text += '"';
}

void
JsonWriter::Name(const char * name)
{
  m_Text += m_First ? "" : ", ";
  this->Write(name);
  m_Text += ": ";
}

} // namespace sensornoise
