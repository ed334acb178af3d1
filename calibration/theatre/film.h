// SPDX-License-Identifier: Apache-2.0
// A clip of the wall from the pictures that nodes wrote every few frames.
#pragma once

#include <string>

#include "common/config/rig.h"

namespace aquarama {

// Composes every folder/film/FRAME/ (channel-NAME.png of every channel) to a panorama and writes
// them, in the order of their frames, as the looping folder/clip.webp at the speed of the world;
// then removes folder/film. Throws Error when a picture is missing or the clip cannot be written.
void composeFilm(const Rig& rig, const std::string& folder);

}  // namespace aquarama
