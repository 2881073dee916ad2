// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_CrossedRegion_h
#define sensornoise_scene_CrossedRegion_h

#include "SensorNoiseExport.h"
#include "scene/ProvisionalModel.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

/** Finds the part of the frame that something crosses: 1 there, by cells of the frame; empty if there is none.
 *
 * A person who walks through a burst disturbs all that they pass, which may be most of the frame. A model of the
 * variance that the majority draws is then one of the person, and flicker and motion found with it are wrong. But what
 * moves can only add variance: the model of what is still is the one with no cells of the frame below it, and with as
 * many that fit it as possible; a third of the frame is enough, or less.
 *
 * Where \a model, which all usable pixels drew, explains 85 % of the frame, and little lies below it, nothing is looked
 * for: smaller things are left to FindUnexplained and to the third pass. Else models are drawn by parts of the frame:
 * halves, thirds and ninths, each then followed over all cells that fit it. The cells that are above the best one are
 * the region, closed: their neighbours, and narrow islands between them, belong to it. Light that changes in some
 * places more than in others is no thing: see FindLocalIllumination. */
SensorNoise_EXPORT std::vector<std::uint8_t>
FindCrossedRegion(const ReferenceFrame & frame, const ProvisionalModel & model);

} // namespace sensornoise

#endif
