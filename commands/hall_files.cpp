// SPDX-License-Identifier: Apache-2.0
#include "commands/hall_files.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <string_view>
#include <system_error>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "common/base/files.h"
#include "common/base/log.h"
#include "common/config/calendar.h"
#include "common/config/hours.h"
#include "common/config/keys.h"
#include "common/config/rig.h"
#include "common/config/scene.h"
#include "common/wire/wanted_show.h"

namespace aquarama {

namespace {

namespace fs = std::filesystem;
using formats::ArchiveFile;

std::span<const std::byte> bytesOf(const std::string& text) {
    return std::as_bytes(std::span(text));
}

// The files that leave, each with its place in the folder that arrives.
class LeavingFiles {
  public:
    // A file that the file `from`, at the place `placeOfFrom`, names as `named`: its place. One
    // from elsewhere comes into `folder`, under its own name.
    [[nodiscard]] static fs::path placeOf(const fs::path& placeOfFrom,
                                          const std::string& named,
                                          const std::string& folder) {
        const fs::path place = (placeOfFrom.parent_path() / named).lexically_normal();
        const bool isInside = place.is_relative() && *place.begin() != "..";
        return isInside ? place : fs::path(folder) / place.filename();
    }

    // A file that several others name is added once. Throws Error where another has its place.
    void add(const fs::path& place, const fs::path& source, std::span<const std::byte> bytes) {
        const auto [there, isNew] = sources_.emplace(place.string(), fs::weakly_canonical(source));
        if (isNew) files_.emplace_back(place.string(), std::vector(bytes.begin(), bytes.end()));
        if (there->second != fs::weakly_canonical(source))
            throw Error(fmt::format("{} and {} would both travel as {}; rename one of them",
                                    there->second.string(),
                                    source.string(),
                                    place.string()));
    }
    [[nodiscard]] std::vector<ArchiveFile> take() { return std::move(files_); }

  private:
    std::vector<ArchiveFile> files_;
    std::map<std::string, fs::path> sources_;
};

// A text in which names of files become those that they have where it arrives.
class RenamedText {
  public:
    // `source` names it in errors, `place` is where it arrives.
    RenamedText(std::string text, std::string source, const fs::path& place)
        : text_{std::move(text)}, source_{std::move(source)}, folder_{place.parent_path()} {}

    // Throws Error where the text has the name in another form.
    void moveName(const std::string& named, const fs::path& placeOfNamed) {
        if ((folder_ / named).lexically_normal() == placeOfNamed) return;
        const std::string from = '"' + named + '"';
        const std::string to = '"' + placeOfNamed.lexically_relative(folder_).string() + '"';
        if (!renamed_.insert(named).second) return;
        std::size_t at = text_.find(from);
        if (at == std::string::npos)
            throw Error(source_ + ": write the path " + named + " in one piece and in \"quotes\"");
        for (; at != std::string::npos; at = text_.find(from, at + to.size()))
            text_.replace(at, from.size(), to);
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_, source_;
    fs::path folder_;
    std::set<std::string> renamed_;
};

// A scene and the species of its cast.
void addScene(LeavingFiles& files, const std::string& path, const fs::path& place) {
    const config::Scene scene = config::readScene(path);
    const std::vector<config::CastSpecies> cast = config::readCastSpecies(scene, path);
    RenamedText text(scene.text, path, place);
    for (std::size_t i = 0; i < cast.size(); ++i) {
        const std::string& named = scene.cast[i].species;
        const fs::path species = LeavingFiles::placeOf(place, named, "species");
        text.moveName(named, species);
        files.add(species, cast[i].path, bytesOf(config::readTextFile(cast[i].path)));
    }
    files.add(place, path, bytesOf(text.text()));
}

// The scene of a rig, and those beside it that its hours name.
void addScenes(LeavingFiles& files,
               const config::Rig& rig,
               const std::string& rigPath,
               const fs::path& place,
               const std::string& hoursPath) {
    const std::string own = config::scenePathOf(rig, rigPath);
    addScene(files, own, place);
    if (!fs::exists(hoursPath)) return;
    const config::Hours hours = config::parseHours(config::readTextFile(hoursPath), hoursPath);
    for (const std::string& name : config::scenesOf(hours)) {
        const std::string other = config::scenePathOf(name, rigPath, rig.scene);
        if (other != own) addScene(files, other, place.parent_path() / fs::path(other).filename());
    }
}

// The regular files of a folder, by name, under `prefix`; none where there is no such folder.
void addFolder(std::vector<ArchiveFile>& secrets, const fs::path& folder, const char* prefix) {
    std::set<fs::path> paths;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
        if (entry.is_regular_file()) paths.insert(entry.path());
    for (const fs::path& path : paths)
        secrets.emplace_back(prefix + path.filename().string(),
                             readWhole(path, config::kMostWallFileBytes));
}

// Where the secrets of a rig lie on this machine.
struct SecretPlaces {
    explicit SecretPlaces(const std::string& rigPath)
        : keys{config::keyFolderOf(rigPath)},
          hours{config::consoleFolderOf(rigPath) / config::kHoursFile},
          drawings{wire::drawingsOf(rigPath)} {}
    fs::path keys, hours, drawings;
};

std::vector<ArchiveFile> secretsOf(const std::string& rigPath, bool drawings) {
    const SecretPlaces places(rigPath);
    std::vector<ArchiveFile> secrets;
    addFolder(secrets, places.keys, kKeysOfHall);
    if (fs::exists(places.hours))
        secrets.emplace_back(config::kHoursFile,
                             readWhole(places.hours, config::kMostWallFileBytes));
    if (drawings) addFolder(secrets, places.drawings, kDrawingsOfHall);
    return secrets;
}

// Throws Error unless it is an empty folder, or not there.
void requireEmpty(const fs::path& folder, const std::string& what) {
    std::error_code none;
    if (fs::exists(folder) && !fs::is_empty(folder, none))
        throw Error(folder.string() + ": " + what);
}

// Where the secrets of a hall arrive, by their folders.
using ArrivingSecrets = std::map<fs::path, ArrivingFiles>;

// Puts a secret aside at its place, which nobody else may read.
void writeSecret(ArrivingSecrets& arriving, const SecretPlaces& places, const ArchiveFile& secret) {
    const auto& [name, bytes] = secret;
    fs::path folder = places.hours.parent_path();
    if (name.starts_with(kKeysOfHall)) folder = places.keys;
    if (name.starts_with(kDrawingsOfHall)) folder = places.drawings;
    const ArrivingFiles& files = arriving.try_emplace(folder, folder).first->second;
    fs::permissions(folder, fs::perms::owner_all);
    writePrivate(files.aside() / fs::path(name).filename(), bytes);
}

// Throws Error where keys or hours cannot be used.
void checkSecret(const ArchiveFile& secret, const std::string& source) {
    const auto& [name, bytes] = secret;
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (name == config::kHoursFile)
        static_cast<void>(config::parseHours(text, source + ": " + name));
    else if (name.starts_with(kKeysOfHall) && name.ends_with(".key"))
        static_cast<void>(config::parseKeyFile(text, source + ": " + name));
}

// Throws Error where the rig cannot be shown from the folder in which it arrives.
void checkRig(const std::string& rigPath) {
    const config::Rig rig = config::readRig(rigPath);
    const std::string scenePath = config::scenePathOf(rig, rigPath);
    static_cast<void>(config::readCastSpecies(config::readScene(scenePath), scenePath));
}

// Throws Error where something is there already that the hall would replace.
void requireRoom(const TravellingHall& hall, const fs::path& folder, const SecretPlaces& places) {
    const std::string of = "a rig named " + fs::path(hall.rig).stem().string() + " has ";
    const auto has = [&](std::string_view prefix) {
        return std::ranges::any_of(
            hall.secrets, [&](const ArchiveFile& one) { return one.first.starts_with(prefix); });
    };
    requireEmpty(folder, "has files; give an empty or a new folder");
    if (has(kKeysOfHall)) requireEmpty(places.keys, of + "keys here already; move them away first");
    if (has(kDrawingsOfHall))
        requireEmpty(places.drawings, of + "drawings here already; move them away first");
    if (has(config::kHoursFile) && fs::exists(places.hours))
        throw Error(places.hours.string() + ": " + of + "hours here already; move them away first");
}

}  // namespace

TravellingHall readHall(const std::string& rigPath, bool drawings) {
    const config::Rig rig = config::readRig(rigPath);
    const fs::path place = fs::path(rigPath).filename();
    LeavingFiles files;
    RenamedText text(rig.text, rigPath, place);
    for (const auto& [named, content] : rig.files) {
        const fs::path file = LeavingFiles::placeOf(place, named, "wall");
        text.moveName(named, file);
        files.add(file, config::besideFile(rigPath, named), *content);
    }
    const fs::path scene = LeavingFiles::placeOf(place, rig.scene, "scenes");
    text.moveName(rig.scene, scene);
    addScenes(files, rig, rigPath, scene, SecretPlaces(rigPath).hours);
    files.add(place, rigPath, bytesOf(text.text()));
    return {place.string(), files.take(), secretsOf(rigPath, drawings)};
}

fs::path placeHall(const TravellingHall& hall, const fs::path& folder, const std::string& source) {
    fs::path rig = folder / hall.rig;
    const SecretPlaces places(rig.string());
    requireRoom(hall, folder, places);
    for (const ArchiveFile& secret : hall.secrets) checkSecret(secret, source);
    ArrivingFiles files(folder);
    for (const auto& [name, bytes] : hall.files) writeWhole(files.aside() / name, bytes);
    checkRig((files.aside() / hall.rig).string());
    ArrivingSecrets secrets;
    for (const ArchiveFile& secret : hall.secrets) writeSecret(secrets, places, secret);
    for (const auto& [where, arriving] : secrets) arriving.settle();
    files.settle();
    return rig;
}

}  // namespace aquarama
