// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_report_JsonWriter_h
#define sensornoise_report_JsonWriter_h

#include "base/Text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace sensornoise
{

/** \class JsonWriter
 * \brief Appends JSON to a string.
 *
 * A number has the fewest digits that are read back as the same double. NaN and infinity are written as null, because
 * JSON cannot represent them. Strings are UTF-8; quotes, backslashes and control characters are escaped. */
class JsonWriter
{
public:
  /** Constructs a writer that appends to \a text, which must outlive the writer. */
  explicit JsonWriter(std::string & text)
    : m_Text(text)
  {}

  /** Writes a value: a number, true or false, a string, an array, or null for an empty optional. */
  void
  Write(double number)
  {
    if (!std::isfinite(number))
    {
      m_Text += "null";
      return;
    }
    m_Text += ShortestText(number);
  }
  void
  Write(std::size_t number)
  {
    m_Text += std::to_string(number);
  }
  void
  Write(int number)
  {
    m_Text += std::to_string(number);
  }
  void
  Write(unsigned int number)
  {
    m_Text += std::to_string(number);
  }
  void
  Write(bool truth)
  {
    m_Text += truth ? "true" : "false";
  }
  void
  Write(const char * string)
  {
    this->Write(std::string(string));
  }
  void
  Write(const std::string & string)
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
  template <typename T>
  void
  Write(const std::optional<T> & optional)
  {
    if (optional)
    {
      this->Write(*optional);
    }
    else
    {
      m_Text += "null";
    }
  }
  template <typename... TAlternatives>
  void
  Write(const std::variant<TAlternatives...> & value)
  {
    std::visit([this](const auto & held) { this->Write(held); }, value);
  }
  template <typename T, std::size_t VSize>
  void
  Write(const std::array<T, VSize> & values)
  {
    this->WriteList(values);
  }
  template <typename T>
  void
  Write(const std::vector<T> & values)
  {
    this->WriteList(values);
  }
  /** Writes a value of another type. It calls the function WriteJson(JsonWriter &, const T &) in the namespace of the
   * type. */
  template <typename T>
  void
  Write(const T & value)
  {
    WriteJson(*this, value);
  }

  /** Writes an object. \a members() writes its members. */
  template <typename TMembers>
  void
  Object(TMembers members)
  {
    m_Text += '{';
    m_First = true;
    members();
    m_Text += '}';
    m_First = false;
  }
  /** Writes a member of the current object, and returns the writer for the next one. */
  template <typename T>
  JsonWriter &
  Member(const char * name, const T & value)
  {
    this->Name(name);
    this->Write(value);
    m_First = false;
    return *this;
  }
  /** Writes a member that is an object. \a members() writes its members. Returns the writer. */
  template <typename TMembers>
  JsonWriter &
  ObjectMember(const char * name, TMembers members)
  {
    this->Name(name);
    this->Object(members);
    return *this;
  }

private:
  /** Writes the name of a member with its colon, after a comma unless the member is the first one. */
  void
  Name(const char * name)
  {
    m_Text += m_First ? "" : ", ";
    this->Write(name);
    m_Text += ": ";
  }
  template <typename TValues>
  void
  WriteList(const TValues & values)
  {
    m_Text += '[';
    const char * separator = "";
    for (const auto & value : values)
    {
      m_Text += separator;
      this->Write(value);
      separator = ", ";
    }
    m_Text += ']';
  }

  std::string & m_Text;
  bool          m_First{ true }; // the current object has no member yet
};

} // namespace sensornoise

#endif
