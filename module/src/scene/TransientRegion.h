// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_TransientRegion_h
#define sensornoise_scene_TransientRegion_h

#include "SensorNoiseExport.h"
#include "sensornoise/FrameGeometry.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Comparison of the raw variance of the pixels of a cell with a model. */
enum class CellFit : std::uint8_t
{
  Unknown, ///< fewer than 8 pixels of the sample lie in it
  Fits,
  Below, ///< the variance is below the model
  Above  ///< the median variance, or the variance of many of its pixels, is above the model
};

/** All cells, compared with a model. The fractions are of the pixels of the known cells, and add up to 1. */
struct TileComparison
{
  std::vector<CellFit> fits;           ///< row by row
  double               fitting{ 0.0 }; ///< fraction that fits [1]
  double               below{ 0.0 };   ///< fraction below the model [1]
  double               above{ 0.0 };   ///< fraction above the model [1]
};

/** Test whether changes of the illumination explain the cells above a model: the signal of every pixel changes by the
 * same factor. */
struct IlluminationTest
{
  double explained{ 0.0 };  ///< fraction of the cells whose pixels are explained by one flicker per cell [1]
  double modulation{ 0.0 }; ///< square root of the ratio of the variance above the model to the squared level above the
                            ///< darkest one [1]
};

/** \class VarianceTiles
 * \brief Rectangles of the frame, at most 24 x 24 and at least 8 pixels wide, by which the raw variance is compared
 * with a model. The median of some 60 pixels yields the variance of a cell to a few per cent. */
class SensorNoise_EXPORT VarianceTiles
{
public:
  /** \a pixels are the pixels of \a sample, which must outlive the object; \a frames is the number of frames T. */
  VarianceTiles(const VarianceSample &           sample,
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
  /** Returns the cell of pixel \a p of the frame. */
  std::size_t
  CellOfPixel(std::size_t p) const
  {
    const std::size_t x = p % m_Geometry.width;
    const std::size_t y = p / m_Geometry.width;
    return y * m_Rows / m_Geometry.height * m_Columns + x * m_Columns / m_Geometry.width;
  }
  /** Returns the cell of pixel \a i of the sample. */
  std::size_t
  CellOf(std::size_t i) const
  {
    return m_CellOf[i];
  }
  /** Compares the cells with the variance that a model predicts. */
  TileComparison
  Compare(const VariancePrediction & prediction) const;

  /** Tests whether changes of the illumination explain the cells of \a comparison that are above the model: a separate
   * flicker in every cell. A pixel is not explained if its variance differs by more than the factor \a largestRatio. */
  IlluminationTest
  TestIllumination(const TileComparison & comparison, const VariancePrediction & prediction, double largestRatio) const;

private:
  const VarianceSample & m_Sample;
  FrameGeometry          m_Geometry;
  std::size_t            m_Columns;
  std::size_t            m_Rows;
  double                 m_MedianRatio; // ratio of the median of a variance with T - 1 degrees of freedom to its
                                        // expectation
  std::vector<std::size_t> m_CellOf;    // cells of the pixels of the sample
};

/** Finds the part of the frame that a moving object crosses. Returns 1 there, by cells of the frame; empty if there is
 * none.
 *
 * A person who walks through a burst disturbs all pixels on the way, which may be most of the frame. A model of the
 * variance fitted to the majority then describes the person, and flicker and motion found with it are wrong. But a
 * moving object only adds variance. The model of the static scene therefore has no cells below it, and as many cells
 * as possible fit it; a third of the frame or less is enough.
 *
 * Nothing is searched where \a model, which was fitted to all usable pixels, explains 85 % of the frame and few cells
 * lie below it. Smaller objects are left to FindOutlierPixels() and to the third pass. Otherwise models are fitted to
 * parts of the frame: halves, thirds and ninths. Each is then extended over all cells that fit it. The cells above the
 * best model are the region, with their neighbours and the narrow islands between them. Local changes of the
 * illumination are not an object, see FindLocalIllumination(). */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindTransientRegion(const ReferenceFrame & frame, const InitialNoiseModel & model);

} // namespace sensornoise

#endif
