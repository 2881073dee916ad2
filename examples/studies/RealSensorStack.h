// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef RealSensorStack_h
#define RealSensorStack_h

#include "sensornoise/Simulator.h"
#include "studies/RealSensorSetting.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sensornoise::tools
{

/** \class RealSensorStack
 * A simulated burst of one setting, square frames.
 *
 * The simulator stretches a scene to [0, electrons]. A scene that does not fill this range gets more rows below the
 * frame: copies of its last row, which keep blur and vibration as they are at an edge, then a black and a white field.
 * These rows are simulated, but are no part of the frames. */
class RealSensorStack
{
public:
  /** \param size width and height [pixels], at least 32
   * \param isDark the same sensor with the shutter closed
   * \throws std::invalid_argument if the setting cannot be used */
  RealSensorStack(const RealSensorSetting & setting, std::size_t size, std::uint64_t seed, bool isDark = false);

  /** All codes, frame after frame [DN]. */
  std::vector<std::uint16_t>
  Render() const;

  /** Its first Pixels() pixels are those of the frame. */
  const StackSimulator &
  GetSimulator() const
  {
    return m_Simulator;
  }
  std::size_t
  Pixels() const
  {
    return m_Size * m_Size;
  }

private:
  /** One row whose light the simulator does not know: the block crosses, or there are two lamps. */
  void
  RenderLitRow(std::size_t t, std::size_t y, std::uint16_t * out) const;

  void
  DrawBlock(std::size_t t, std::size_t y, std::vector<double> & electrons) const;

  RealSensorSetting   m_Setting;
  std::size_t         m_Size;
  StackSimulator      m_Simulator;
  std::vector<double> m_Lamps; ///< flicker of both lamps in each frame [1]; empty: one lamp
  std::vector<double> m_Block; ///< texture of what crosses, as wide and high as the block [1]; empty: nothing does
};

} // namespace sensornoise::tools

#endif
