// SPDX-License-Identifier: Apache-2.0
#include "releases/shelf.h"

#include <algorithm>

#include "common/base/durable.h"
#include "common/base/files.h"
#include "common/base/log.h"

namespace aquarama::releases {

namespace fs = std::filesystem;

fs::path Shelf::folderOf(const std::string& version) const {
    return system_ / "aquarama" / version;
}

std::vector<fs::path> Shelf::entryFiles() const {
    if (!fs::is_directory(entryFolder()))
        throw Error(entryFolder().string() + ": is not there; name the system partition's folder");
    std::vector<fs::path> files;
    for (const auto& file : fs::directory_iterator(entryFolder()))
        if (entryOf(file.path().filename().string())) files.push_back(file.path());
    return files;
}

std::vector<BootEntry> Shelf::entries() const {
    std::vector<BootEntry> entries;
    for (const fs::path& file : entryFiles()) {
        if (fs::is_empty(file)) continue;
        BootEntry entry = *entryOf(file.filename().string());
        entry.release = idIn(folderOf(entry.release.version));
        entries.push_back(entry);
    }
    return entries;
}

std::vector<ReleaseId> Shelf::good() const {
    std::vector<ReleaseId> good;
    for (const BootEntry& entry : entries())
        if (!entry.triesLeft) good.push_back(entry.release);
    return good;
}

void Shelf::change(const std::vector<BootStep>& steps, const Machine& machine) const {
    for (const fs::path& file : entryFiles())
        if (fs::is_empty(file)) removeDurably(file);
    for (const BootStep& step : steps) {
        const fs::path file = entryFolder() / step.entry.file;
        if (step.what == BootStep::What::Rename) {
            renameDurably(file, step.to);
        } else if (step.what == BootStep::What::Remove) {
            removeDurably(file);
        } else {
            const std::string text = machine.entry(step.entry.release);
            writeWhole(file, std::as_bytes(std::span(text)));
        }
    }
}

void Shelf::keepOnly(const std::vector<ReleaseId>& kept, const Machine& machine) const {
    const auto isKept = [&](const ReleaseId& id) {
        return std::ranges::find(kept, id.version, &ReleaseId::version) != kept.end();
    };
    if (std::ranges::none_of(good(), isKept)) return;
    change(stepsToForget(entries(), kept), machine);
    for (const auto& folder : fs::directory_iterator(system_ / "aquarama"))
        if (!isKept({folder.path().filename().string(), 0})) fs::remove_all(folder.path());
}

}  // namespace aquarama::releases
