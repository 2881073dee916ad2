// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_page_SvgPanel_h
#define sensornoise_page_SvgPanel_h

#include <string>
#include <vector>

namespace sensornoise
{

/** A range of numbers with round ticks inside it. */
struct PlotAxis
{
  double              low{ 0.0 };
  double              high{ 1.0 };
  std::vector<double> ticks;
  int                 decimals{ 0 }; ///< of the ticks' labels

  std::string
  LabelOf(double tick) const;

  /** Room for the widest label, in a font of figures as wide as any common one has. */
  double
  LabelWidth() const;
};

/** The axis over [\a low, \a high], a little wider, with at most \a mostTicks ticks at multiples of 1, 2 or 5 times a
 * power of ten. Ends that are not finite, or equal, are replaced by such as can be drawn. */
PlotAxis
MakeAxis(double low, double high, int mostTicks);

/** The least and the largest finite number of lists. */
class FiniteRange
{
public:
  void
  Add(const std::vector<double> & values);
  void
  Add(double value);
  PlotAxis
  Axis(int mostTicks) const;

private:
  double m_Low{ 0.0 };
  double m_High{ 0.0 };
  bool   m_IsEmpty{ true };
};

/** A number for an attribute: one decimal place, in any locale with a point. */
std::string
SvgNumber(double number);

/** Colours of the figures, light and dark: after those of Okabe and Ito, which people without colour vision tell apart,
 * too, and every kind has a shape or a dash of its own besides. Plain colours, no variables: not every viewer of SVG
 * files knows those. */
inline constexpr const char * FigureStyle = R"(
svg text{fill:#1b1f24;font:14px system-ui,sans-serif}
svg .paper{fill:#fff}
svg .frame{fill:none;stroke:#57606a}
svg .grid{fill:none;stroke:#d8dee4}
svg .line{fill:none;stroke-width:1.8}
svg .point{fill:none;stroke-width:1.2}
svg .before{stroke:#b85c00}
svg .after{stroke:#0072b2}
svg .third{stroke:#00795a}
svg .zero{stroke:#57606a;stroke-width:1}
svg .after.full,svg .after.band,svg .bar{fill:#0072b2}
svg .third.band{fill:#00795a}
svg .band{stroke:none;opacity:.22}
svg .error{fill:none;stroke:#1b1f24;stroke-width:1.4}
svg .dashed{stroke-dasharray:7 5}
@media(prefers-color-scheme:dark){
svg text{fill:#e6edf3}
svg .paper{fill:#0d1117}
svg .frame,svg .zero{stroke:#a3adb8}
svg .grid{stroke:#2a313a}
svg .before{stroke:#e69f00}
svg .after{stroke:#56b4e9}
svg .third{stroke:#2fc79a}
svg .band{stroke:none}
svg .after.full,svg .after.band,svg .bar{fill:#56b4e9}
svg .third.band{fill:#2fc79a}
svg .error{stroke:#e6edf3}
}
)";

/** Width of every figure in its units: small enough that text is still read where a telephone shows it 350 pixels wide.
 */
inline constexpr double FigureWidth = 480.0;

/** The first tag of a figure. \a label: what it shows, for those who do not see it. */
std::string
OpenSvg(double height, const std::string & label);

/** A \a figure of a page as an SVG file of its own, light or dark as its viewer is. \a title: what was measured, in
 * words. */
std::string
AsSvgFile(std::string figure, const std::string & title);

enum class PlotMarker
{
  Disc,
  Ring,
  Square
};

/** \class SvgPanel
 * \brief Draws into one rectangle of an SVG figure, by the coordinates of its axes. What is not finite is left out, and
 * what lies outside is cut off. Colours are classes of FigureStyle.
 */
class SvgPanel
{
public:
  struct Box
  {
    double left;
    double top;
    double width;
    double height;
  };

  /** Appends to \a svg the axes, their ticks and their names. \a xName "": the ticks of x have no labels. */
  SvgPanel(std::string &       svg,
           const Box &         box,
           PlotAxis            x,
           PlotAxis            y,
           const std::string & xName,
           const std::string & yName);
  SvgPanel(const SvgPanel &) = delete;
  SvgPanel &
  operator=(const SvgPanel &) = delete;
  /** Closes the rectangle. */
  ~SvgPanel();

  void
  Points(const std::vector<double> & x, const std::vector<double> & y, const char * style, PlotMarker marker);
  /** Through the points, with a gap where one is not finite. */
  void
  Line(const std::vector<double> & x, const std::vector<double> & y, const char * style);
  void
  Band(const std::vector<double> & x,
       const std::vector<double> & low,
       const std::vector<double> & high,
       const char *                style);
  /** From side to side at \a y. */
  void
  Level(double y, const char * style);

  /** Inside the rectangle. */
  double
  X(double x) const;
  double
  Y(double y) const;

private:
  void
  DrawAxes(const std::string & xName, const std::string & yName);

  std::string & m_Svg;
  Box           m_Box;
  PlotAxis      m_X;
  PlotAxis      m_Y;
};

} // namespace sensornoise

#endif
