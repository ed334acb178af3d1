// SPDX-License-Identifier: Apache-2.0
// The species that these tests swim with, and its repertoire, captured once for all of them.
#pragma once

#include "capture/capture_repertoire.h"
#include "common/config/species.h"
#include "common/motion/repertoire.h"

namespace aquarama::test {

inline const char* const kScadFile = AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb";

inline const config::Species& scad() {
    static const config::Species species = config::readSpecies(kScadFile);
    return species;
}

inline const motion::Repertoire& scadRepertoire() {
    static const motion::Repertoire repertoire = capture::captureRepertoire(scad(), [](double) {});
    return repertoire;
}

inline const motion::ActionSegment& segmentOf(motion::Action action) {
    return scadRepertoire().segments.at(static_cast<std::size_t>(action));
}

}  // namespace aquarama::test
