// SPDX-License-Identifier: Apache-2.0
#include "commands/master_options.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "commands/commands.h"
#include "commands/rig_file_watch.h"
#include "common/config/hours.h"
#include "common/config/scene.h"
#include "common/wire/wanted_show.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;

// The quality; empty: the nodes measure which one they can draw. In lockstep no clock is read, so
// nothing is measured.
std::optional<config::QualityTier> qualityOf(const config::Rig& rig, const MasterOptions& options) {
    constexpr config::QualityTier kOfLockstep = config::QualityTier::Low;
    if (!options.show.quality.empty()) return config::tierNamed(options.show.quality);
    if (!rig.quality && options.lockstep) return kOfLockstep;
    return rig.quality;
}

// The suffix of a scene's file. A text without it is the name of a scene beside the rig's scene.
constexpr std::string_view kSceneEnding = ".txtpb";

// The names of scenes without suffix, sorted, for an error message.
std::string scenesIn(const fs::path& folder) {
    std::vector<std::string> names;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder))
        if (entry.path().extension() == kSceneEnding) names.push_back(entry.path().stem().string());
    std::ranges::sort(names);
    std::string list;
    for (const std::string& one : names) list += (list.empty() ? "" : ", ") + one;
    return list;
}

// What is chosen for this run: by the options, else by the rig.
v1::WantedShow chosenBy(const MasterOptions& options) {
    const supervisor::ShowOptions& show = options.show;
    v1::WantedShow chosen;
    if (!show.scenePath.empty()) chosen.set_scene(show.scenePath);
    if (!show.quality.empty()) chosen.set_quality(wire::tierOf(config::tierNamed(show.quality)));
    if (const auto pattern = wire::patternNamed(show.pattern))
        chosen.set_pattern(static_cast<v1::WantedShow::Shown>(*pattern));
    return chosen;
}

// What earlier runs were told to show. A file that cannot be read does not keep the wall dark.
v1::WantedShow keptShow(const config::Rig& rig, const MasterOptions& options) {
    const fs::path path = wire::keptShowOf(options.show.rigPath);
    try {
        v1::WantedShow kept = wire::readKeptShow(path);
        if (kept.has_scene()) static_cast<void>(sceneFile(rig, options.show.rigPath, kept.scene()));
        return kept;
    } catch (const Error& problem) {
        logWarning("what was set before is not shown: {}", problem.what());
        return {};
    }
}

// The values with which the show begins. A live show begins with earlier values, overridden by the
// options of its command line. A restarted master keeps all values that were set.
void chooseWanted(const config::Rig& rig,
                  const MasterOptions& options,
                  conductor::ConductorOptions& conductor) {
    conductor.wanted.set_scene(fs::path(rig.scene).stem().string());
    conductor.wanted.set_quality(wire::tierOf(qualityOf(rig, options)));
    const bool isKept = !options.lockstep && options.show.replayPath.empty();
    if (isKept) {
        conductor.keptAt = wire::keptShowOf(options.show.rigPath);
        conductor.drawingsAt = wire::drawingsOf(options.show.rigPath);
        conductor.kept = keptShow(rig, options);
    }
    const v1::WantedShow chosen = chosenBy(options);
    const auto& [under, over] =
        options.resume ? std::pair{chosen, conductor.kept} : std::pair{conductor.kept, chosen};
    wire::apply(conductor.wanted, under);
    wire::apply(conductor.wanted, over);
    if (const std::string text = wire::textOf(conductor.kept); !text.empty())
        logInfo("as it was set before: {} (change it with aquarama set)", text);
}

}  // namespace

std::string sceneFile(const config::Rig& rig, const std::string& rigPath, const std::string& name) {
    if (name.ends_with(kSceneEnding)) return name;
    const fs::path folder = fs::path(config::scenePathOf(rig, rigPath)).parent_path();
    const fs::path file = folder / (name + std::string(kSceneEnding));
    if (fs::is_regular_file(file)) return file.string();
    throw Error("there is no scene \"" + name + "\" in " + folder.string() + ", only " +
                scenesIn(folder));
}

simulation::AssetChoice choiceOf(const config::Rig& rig, const supervisor::ShowOptions& options) {
    simulation::AssetChoice choice{.seed = options.seed, .fish = {}};
    if (!rig.drawings) return choice;
    choice.drawnSpecies = rig.drawings->species;
    choice.mostDrawings = rig.drawings->most;
    choice.drawingsMayBeEaten = rig.drawings->mayBeEaten;
    return choice;
}

conductor::ConductorOptions conductorOptions(const config::Rig& rig, const MasterOptions& options) {
    conductor::ConductorOptions conductor;
    conductor.pace = options.lockstep ? wire::Pace::Lockstep : wire::Pace::Live;
    chooseWanted(rig, options, conductor);
    conductor.frames = options.show.frames;
    conductor.traceDirectory = options.show.traceFolder;
    conductor.log = options.log.get();
    conductor.service = options.service;
    conductor.guestsKey = guestsKeyOf(rig, options.show);
    conductor.hoursAt = config::consoleFolderOf(options.show.rigPath) / config::kHoursFile;
    if (!rig.files.empty()) conductor.looks.changedRig = RigFileWatch(rig, options.show.rigPath);
    if (options.mastership == nullptr) return conductor;
    conductor.machine = options.machine;
    conductor.isSuperseded = [leads = options.mastership] { return leads->isLost(); };
    conductor.resign = [leads = options.mastership] { leads->resign(); };
    return conductor;
}

}  // namespace aquarama
