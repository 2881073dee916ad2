// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_StaticScene_h
#define sensornoise_scene_StaticScene_h

#include "SensorNoiseExport.h"
#include "moments/FrameThumbnails.h"
#include "sensornoise/FrameGeometry.h"
#include "base/NothingToMeasure.h"
#include "sensornoise/Parallel.h"
#include "moments/StackMaps.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sensornoise
{

/** A strip along a border of the frame that is not part of the scene. */
struct MaskedStrip
{
  const char * words{ "" };     ///< description, such as "leftmost columns"
  std::size_t  lines{ 0 };      ///< number of columns or rows; 0: there is no strip
  double       levelDn{ 0.0 };  ///< median level of the strip [DN]
  double       besideDn{ 0.0 }; ///< median of the line of the scene next to it [DN]
};

/** The strips of the four borders, and the numbers of their columns or rows. Estimator.md, 3.2. */
struct SensorNoise_EXPORT MaskedBorder
{
  std::vector<MaskedStrip> strips; ///< strips that were found, in the order left, right, top, bottom
  std::size_t              left{ 0 };
  std::size_t              right{ 0 };
  std::size_t              top{ 0 };
  std::size_t              bottom{ 0 };

  bool
  Holds(std::size_t x, std::size_t y, const FrameGeometry & geometry) const
  {
    return x < left || y < top || x + right >= geometry.width || y + bottom >= geometry.height;
  }
  /** Returns the number of pixels of all strips. */
  std::size_t
  Pixels(const FrameGeometry & geometry) const
  {
    return geometry.Pixels() - (geometry.width - left - right) * (geometry.height - top - bottom);
  }
};

/** Finds the optical-black columns and rows, and other dark border regions, in the \a mean levels [DN] of the \a valid
 * pixels. They are strips that end along a whole border within one pixel, unlike the image of a scene: strips of one
 * level, or strips without the structure of the scene. */
SensorNoise_EXPORT MaskedBorder
FindMaskedBorder(const std::vector<double> &       mean,
                 const std::vector<std::uint8_t> & valid,
                 const FrameGeometry &             geometry);

/** Pixels that saturate before the digital numbers do, each at its own full well. */
struct FullWells
{
  double levelDn{ 0.0 };      ///< median level of the full wells [DN]
  double spreadDn{ 0.0 };     ///< their standard deviation [DN]
  double firstLevelDn{ 0.0 }; ///< level from which a pixel may be saturated [DN]
};

/** Finds the full wells of the pixels in the maps of a stack. Extreme values do not repeat there. But the brightest
 * pixels have less noise than pixels that are a little darker, as little as the darkest ones. Null: there are none.
 * Estimator.md, 3.2. */
SensorNoise_EXPORT std::optional<FullWells>
FindFullWells(const StackMaps & maps, const FrameGeometry & geometry);

/** Static scene, the result of the first pass: the mean image, a rough model of its noise, and the usable pixels. */
struct StaticScene
{
  StackSummary             summary;
  MaskedBorder             border;     ///< strips that are not part of the scene, which are excluded
  std::optional<FullWells> fullWells;  ///< saturated pixels without a clip level, which are excluded
  std::size_t              valid{ 0 }; ///< number of pixels that are finite, never at a clip level, and not masked by
                                       ///< the user
  ReferenceFrame            frame;     ///< `usable` marks the usable pixels of the scene
  InitialNoiseModel         model;
  std::vector<std::uint8_t> pixelUse;      ///< values of PixelUse, as far as one pass determines them
  double                    usable{ 0.0 }; ///< number of usable pixels
  std::size_t               nearClip{ 0 }; ///< number of pixels that clipping could affect
  std::size_t               coarse{ 0 };   ///< number of pixels whose noise is below half a quantization
                                           ///< step
  bool changesStrongly{ false };           ///< whether the illumination changes strongly

  /** Reason why the stack cannot be measured; the model may then be missing. Null: it can be measured. */
  std::optional<NothingToMeasure> failureReason;
};

/** Results of LevelProjection that the scene needs beside the maps, if the illumination changes strongly. */
struct StrongChange
{
  double              darkestNoiseDn2{ 0.0 }; ///< upper bound of the noise variance in the darkest frame [DN^2]
  std::vector<double> rawVariance;            ///< variance with the changes of the illumination [DN^2]
};

/** A scene, and the pixels that only the sums of the second pass leave out. */
struct SceneAndOutliers
{
  StaticScene               scene;
  std::vector<std::uint8_t> outliers; ///< see FindOutlierPixels(); empty if the scene cannot be measured
};

/** Makes the scene from the maps of a stack.
 * \param userMask if not empty, nonzero at the pixels to be used
 * \param frames number of distinct frames
 * \param frameMeans means of the frames [DN]
 * \param cellVariances see FindTransientRegion()
 * \param strongChange if given, the illumination changes strongly, and the variance in \a maps is without these
 * changes. The model, the usable pixels and the outliers are found with it. The frame of the scene has the raw
 * variance */
SensorNoise_EXPORT SceneAndOutliers
MakeStaticScene(StackMaps                         maps,
                const std::vector<std::uint8_t> & userMask,
                const FrameGeometry &             geometry,
                std::size_t                       frames,
                const std::vector<double> &       frameMeans,
                const std::vector<CellVariance> & cellVariances,
                std::optional<StrongChange>       strongChange,
                const ParallelFor &               parallelFor = SerialFor);

} // namespace sensornoise

#endif
