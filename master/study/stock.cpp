// SPDX-License-Identifier: Apache-2.0
#include "master/study/stock.h"

#include <algorithm>
#include <utility>

#include "common/config/species.h"
#include "common/motion/motor.h"
#include "common/motion/repertoire.h"
#include "common/net/blob.h"
#include "common/units/error.h"
#include "master/capture/compile/config_folder.h"
#include "master/capture/compile/progress_bar.h"
#include "master/capture/compile/repertoire_cache.h"

namespace aquarama {

namespace {

std::vector<RepertoireFile> captured(const std::vector<SpeciesText>& texts) {
    ProgressBar bar("capturing");
    return repertoiresFor(texts,
                          defaultBlobDirectory().parent_path() / "repertoires",
                          {.progress = [&](double share) { bar.show(share); }});
}

StockedSpecies stocked(const SpeciesText& text, const RepertoireFile& file) {
    if (!file.error.empty()) throw Error(text.source + ": " + file.error);
    const Species species = parseSpecies(text.text, text.source);
    StockedSpecies stocked;
    stocked.species.tables = makeMotorTables(decodeRepertoire(file.bytes, text.source));
    stocked.species.lengths = {.meanMetres = static_cast<float>(species.size.meanMetres),
                               .deviationMetres = static_cast<float>(species.size.deviationMetres),
                               .leastMetres = static_cast<float>(species.size.leastMetres),
                               .mostMetres = static_cast<float>(species.size.mostMetres)};
    stocked.species.name = species.name;
    stocked.species.habits = species.habits;
    stocked.halfWidth = std::ranges::max(species.profile.halfWidth);
    return stocked;
}

}  // namespace

Stock::Stock(const std::filesystem::path& configFolder) {
    std::vector<SpeciesText> texts;
    for (const auto& file : speciesFiles({}, configFolder)) texts.push_back(readSpeciesText(file));
    const std::vector<RepertoireFile> repertoires = captured(texts);
    for (std::size_t i = 0; i < texts.size(); ++i)
        species_.push_back(stocked(texts[i], repertoires[i]));
}

const StockedSpecies& Stock::at(const std::string& name) const {
    const auto found = std::ranges::find(
        species_, name, [](const StockedSpecies& one) { return one.species.name; });
    if (found == species_.end()) throw Error("there is no species " + name);
    return *found;
}

StudyCast Stock::cast(const std::vector<std::pair<std::string, std::uint32_t>>& fish) const {
    StudyCast cast;
    for (const auto& [name, count] : fish) {
        const StockedSpecies& stocked = at(name);
        cast.species.push_back(stocked.species);
        cast.species.back().fish = count;
        cast.halfWidths.push_back(stocked.halfWidth);
    }
    return cast;
}

}  // namespace aquarama
