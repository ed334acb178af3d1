// SPDX-License-Identifier: Apache-2.0
// How well a simulated photograph of a coloured sheet is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drawings/catalogue.h"
#include "drawings/read.h"
#include "drawings/refusal.h"

namespace aquarama::test {

// Of one photograph.
struct Judged {
    std::string species;
    std::optional<drawings::RefusalReason> refused;
    double colourDifference = 0;  // mean CIEDE2000 within the outline
    double outlineShare = 0;      // largest distance of the outline from where it is, in its length
    double seconds = 0;           // processor time of reading
    std::vector<std::byte> photo = {}, skin = {};  // files: JPEG, PNG
};

// The photograph of this seed, of the species whose turn it is. With AQUARAMA_SHOTS in the
// environment, which names a folder, photograph and skin are kept there.
[[nodiscard]] Judged judge(drawings::Catalogue& catalogue,
                           const std::vector<std::string>& species,
                           std::uint32_t seed,
                           double mostMegapixels);

// What is said of the photographs of the first seeds.
struct Judgement {
    int found = 0;
    double colourDifference = 0;  // mean over those found
    double worstColourDifference = 0, worstOutlineShare = 0;
};
// `also` sees each.
[[nodiscard]] Judgement judgeAll(drawings::Catalogue& catalogue,
                                 const std::vector<std::string>& species,
                                 int count,
                                 double mostMegapixels,
                                 const std::function<void(const Judged&)>& also);

}  // namespace aquarama::test
