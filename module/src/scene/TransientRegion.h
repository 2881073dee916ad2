// SPDX-FileCopyrightText: the ITKSensorNoise contributors
// SPDX-License-Identifier: Apache-2.0
#ifndef sensornoise_scene_TransientRegion_h
#define sensornoise_scene_TransientRegion_h

#include "SensorNoiseExport.h"
#include "scene/InitialNoiseModel.h"
#include "scene/ReferenceFrame.h"

#include <cstdint>
#include <vector>

namespace sensornoise
{

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
