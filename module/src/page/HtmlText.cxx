// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#include "page/PageSections.h"

#include "base/Text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>

namespace sensornoise
{
namespace
{
const std::string PlusMinus = " +- ";

/** Returns \a number with U+2212 for a minus at its beginning. The sign of an exponent stays. */
std::string
WithMinus(const std::string & number)
{
  return number.rfind('-', 0) == 0 ? "\u2212" + number.substr(1) : number;
}

/** Returns the number rounded to the second digit of the error, or by Rounded() without an error above 0. */
std::string
RoundedTo(double number, const std::optional<double> & error)
{
  if (!error || !(*error > 0.0) || !std::isfinite(*error))
  {
    return WithMinus(Rounded(number));
  }
  const std::string text = Measured(number, *error);
  return WithMinus(text.substr(0, text.find(PlusMinus)));
}

std::string
WithReplaced(std::string text, const std::string & found, const std::string & replacement)
{
  for (std::size_t at = text.find(found); at != std::string::npos; at = text.find(found, at + replacement.size()))
  {
    text.replace(at, found.size(), replacement);
  }
  return text;
}
} // namespace

std::string
LabelText(const std::string & label)
{
  const std::string squares = WithReplaced(WithReplaced(label, "^2", "\u00B2"), " - ", " \u2212 ");
  return WithReplaced(WithReplaced(squares, "sigma", "\u03C3"), " mu", " \u03BC");
}

std::string
SentenceText(const std::string & message)
{
  std::string text = WithReplaced(message, PlusMinus, " \u00B1 ");
  text = WithReplaced(WithReplaced(text, "chi2", "\u03C7\u00B2"), "^2", "\u00B2");
  text = WithReplaced(text, "/e-", "/e\u207B");
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
  {
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  }
  const bool isEnded = text.empty() || text.back() == '.' || text.back() == '!' || text.back() == '?';
  return isEnded ? text : text + ".";
}

std::string
Escaped(const std::string & text)
{
  std::string escaped;
  for (const char c : text)
  {
    switch (c)
    {
      case '&':
        escaped += "&amp;";
        break;
      case '<':
        escaped += "&lt;";
        break;
      case '>':
        escaped += "&gt;";
        break;
      case '"':
        escaped += "&quot;";
        break;
      case '\'':
        escaped += "&#39;";
        break;
      default:
        escaped += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return escaped;
}

std::string
WithCode(const std::string & text)
{
  std::string html;
  bool        isCode = false;
  for (const char c : Escaped(text))
  {
    html += c == '`' ? std::string(isCode ? "</code>" : "<code>") : std::string(1, c);
    isCode = c == '`' ? !isCode : isCode;
  }
  return isCode ? html + "</code>" : html;
}

std::string
WithIndices(const std::string & text)
{
  const auto isOfIndex = [](char c) {
    return c == '.' || (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
  };
  std::string html;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t line = std::min(text.find('_', at), text.size());
    std::size_t       end = std::min(line + 1, text.size());
    while (end < text.size() && isOfIndex(text[end]))
    {
      ++end;
    }
    html += Escaped(text.substr(at, line - at));
    html += line < text.size() ? "<sub>" + Escaped(text.substr(line + 1, end - line - 1)) + "</sub>" : "";
    at = end;
  }
  return html;
}

std::string
FigureElement(const std::string & svg, const std::string & caption)
{
  return "<figure>" + svg + (caption.empty() ? "" : "<figcaption>" + caption + "</figcaption>") + "</figure>\n";
}

std::string
Unbroken(std::string html)
{
  return WithReplaced(std::move(html), "\u00B1 ", "\u00B1&#160;");
}

std::string
UnitText(const std::string & unit)
{
  std::string text;
  for (std::size_t i = 0; i < unit.size(); ++i)
  {
    if (unit.compare(i, 2, "^2") == 0)
    {
      text += "\u00B2";
      ++i;
    }
    else if (unit.compare(i, 2, "e-") == 0)
    {
      text += "e\u207B";
      ++i;
    }
    else
    {
      text += unit[i];
    }
  }
  return text == "1" ? "" : text;
}

std::string
ValueText(const Quantity & quantity)
{
  const std::optional<Interval> & range = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  if (quantity.status == EstimateStatus::UpperLimit && range && range->high)
  {
    return "< " + Rounded(*range->high);
  }
  if (!quantity.value || !std::isfinite(*quantity.value))
  {
    return "\u2013";
  }
  const std::optional<double> & error = quantity.standardError;
  if (!error || !(*error > 0.0) || !std::isfinite(*error))
  {
    return WithMinus(Text(*quantity.value));
  }
  const std::string text = Measured(*quantity.value, *error);
  const std::size_t sign = text.find(PlusMinus);
  return WithMinus(text.substr(0, sign)) + " \u00B1 " + text.substr(sign + PlusMinus.size());
}

std::string
RangeText(const Quantity & quantity)
{
  const std::optional<Interval> & range = quantity.interval95 ? quantity.interval95 : quantity.bracket;
  const bool                      isKnown = range && (!range->low || std::isfinite(*range->low)) &&
                       (!range->high || std::isfinite(*range->high)) && (range->low || range->high);
  if (!isKnown)
  {
    return "";
  }
  const auto end = [&](double number) { return RoundedTo(number, quantity.standardError); };
  if (!range->low)
  {
    return "at most " + end(*range->high);
  }
  return range->high ? end(*range->low) + " to " + end(*range->high) : "at least " + end(*range->low);
}

} // namespace sensornoise
