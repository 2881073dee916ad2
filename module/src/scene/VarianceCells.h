// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_VarianceCells_h
#define sensornoise_scene_VarianceCells_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "scene/VarianceSample.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** How the raw variance of a cell's pixels compares with a model's. */
enum class CellFit : std::uint8_t
{
  Unknown, ///< fewer than 8 pixels of the sample lie in it
  Fits,
  Below, ///< it varies less than the model says
  Above  ///< it varies more, or a crowd of its pixels does
};

/** All cells, compared with a model. The shares are of the pixels of the cells that tell, and add up to 1. */
struct JudgedCells
{
  std::vector<CellFit> fits;           ///< row after row of cells
  double               fitting{ 0.0 }; ///< [1]
  double               below{ 0.0 };   ///< [1]
  double               above{ 0.0 };   ///< [1]
};

/** How the cells above a model change, if it is by light: every pixel in proportion to its level. */
struct LightOfCells
{
  double explained{ 0.0 };  ///< share of the cells whose pixels one flicker a cell explains
  double modulation{ 0.0 }; ///< root of what they vary above the model over their squared level, above the darkest [1]
};

/** \class VarianceCells
 * \brief The rectangles of the frame, at most 24 x 24 and at least 8 pixels wide, by which the raw variance is compared
 * with a model: the median of some 60 pixels tells a cell's variance to a few per cent. */
class SensorNoise_EXPORT VarianceCells
{
public:
  /** \a pixels are those of \a sample, which must outlive the object; \a frames is their number T. */
  VarianceCells(const VarianceSample &           sample,
                const std::vector<std::size_t> & pixels,
                const FrameGeometry &            geometry,
                std::size_t                      frames);

  std::size_t
  Columns() const
  {
    return m_Columns;
  }
  std::size_t
  Rows() const
  {
    return m_Rows;
  }
  /** The cell of pixel \a p of the frame. */
  std::size_t
  CellOfPixel(std::size_t p) const
  {
    const std::size_t x = p % m_Geometry.width;
    const std::size_t y = p / m_Geometry.width;
    return y * m_Rows / m_Geometry.height * m_Columns + x * m_Columns / m_Geometry.width;
  }
  /** The cell of pixel \a i of the sample. */
  std::size_t
  CellOf(std::size_t i) const
  {
    return m_CellOf[i];
  }
  /** Compares the cells with what a model predicts. */
  JudgedCells
  Judge(const VariancePrediction & prediction) const;

  /** Whether light could make the cells of \a judged that are above: a flicker of its own in every cell. Pixels that
   * are \a largestRatio times off are not explained. */
  LightOfCells
  FindLight(const JudgedCells & judged, const VariancePrediction & prediction, double largestRatio) const;

private:
  const VarianceSample &   m_Sample;
  FrameGeometry            m_Geometry;
  std::size_t              m_Columns;
  std::size_t              m_Rows;
  double                   m_MedianRatio; // of a variance of T - 1 degrees of freedom to its expectation
  std::vector<std::size_t> m_CellOf;      // of the sample's pixels
};

} // namespace sensornoise

#endif
