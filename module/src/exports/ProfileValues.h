// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_exports_ProfileValues_h
#define sensornoise_exports_ProfileValues_h

#include "sensornoise/NoiseExport.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sensornoise
{

/** The values of a noise profile, by the names of its members, wherever they stand in the file. */
class ProfileValues
{
public:
  /** Takes the values of a file, by JSON Pointer. */
  explicit ProfileValues(StoredReport record)
    : m_Record(std::move(record))
  {}

  /** Returns the name of the file, for messages. */
  const std::string &
  File() const
  {
    return m_Record.name;
  }

  const StoredReport &
  Record() const
  {
    return m_Record;
  }

  /** Returns whether a member of this name is a number, or holds values. */
  bool
  Has(const std::string & member) const;

  /** Returns the only number with this name; none if there is none. A name may have several parts: "gain/value". Throws
   * ExportError if the file has several: a profile of several cameras or modes does not say which one is meant. */
  std::optional<double>
  Find(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError if there is none, or several, or it is not finite. */
  double
  Number(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError as Number(), or if it is not above 0. */
  double
  Positive(const std::string & member) const;

  /** Returns the only number with this name. Throws ExportError as Number(), or if it is negative. */
  double
  NotNegative(const std::string & member) const;

  /** Returns the numbers of a list, "/list/0", "/list/1" and so on. */
  std::vector<double>
  List(const std::string & list) const;

  /** Returns the texts of a list. */
  std::vector<std::string>
  Texts(const std::string & list) const;

private:
  StoredReport m_Record;
};

/** Returns the values of YAML of nested mappings, "name: value" with indentation: what cameras' records are made of.
 * Lists and flow style are not read. */
StoredReport
ReadYamlValues(const std::string & file, const std::string & text);

} // namespace sensornoise

#endif
