// SPDX-License-Identifier: Apache-2.0
// The species that these tests swim with, and its repertoire, captured once for all of them.
#pragma once

#include "common/config/species.h"
#include "common/motion/repertoire.h"
#include "master/capture/compile/capture_repertoire.h"

namespace aquarama {

inline const char* const kScadFile = AQUARAMA_SOURCE_DIR "/config/species/bigeye_scad.txtpb";

inline const Species& scad() {
    static const Species species = readSpecies(kScadFile);
    return species;
}

inline const Repertoire& scadRepertoire() {
    static const Repertoire repertoire = captureRepertoire(scad(), [](double) {});
    return repertoire;
}

inline const ActionSegment& segmentOf(Action action) {
    return scadRepertoire().segments.at(static_cast<std::size_t>(action));
}

}  // namespace aquarama
