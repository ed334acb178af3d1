// SPDX-License-Identifier: Apache-2.0
#include "drawings/catalogue.h"

#include <algorithm>
#include <filesystem>
#include <sstream>

#include <nlohmann/json.hpp>

#include "common/base/log.h"
#include "common/cli/outputs.h"
#include "common/config/text_file.h"

namespace aquarama::drawings {

namespace {

constexpr const char* kList = "config/sheets.txt";

std::string joined(const std::vector<std::string>& names) {
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return all;
}

// Names of the files with the texts, without their extension.
std::vector<std::string> languages() {
    std::vector<std::string> names;
    const std::filesystem::path english = cli::findData("drawings/texts/en.json");
    for (const auto& file : std::filesystem::directory_iterator(english.parent_path()))
        if (file.path().extension() == ".json") names.push_back(file.path().stem());
    std::ranges::sort(names);
    return names;
}

}  // namespace

Catalogue::Catalogue() {
    const std::string path = cli::findData(kList);
    std::istringstream lines(config::readTextFile(path));
    for (std::string line; std::getline(lines, line);)
        if (!line.empty() && line.front() != '#') names_.push_back(line);
    if (names_.size() > kMostSpecies)
        throw Error(path + ": has more than " + std::to_string(kMostSpecies) +
                    " species, which tags cannot tell: shorten the list");
    for (const std::string& name : names_)
        species_.push_back(config::readSpecies(cli::findData("config/species/" + name + ".txtpb")));
}

const Sheet& Catalogue::sheetOf(const std::string& name) {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end())
        throw Error("no sheet for \"" + name + "\"; there are " + joined(names_));
    return *sheetOf(static_cast<int>(found - names_.begin()));
}

const Sheet* Catalogue::sheetOf(int number) {
    if (number < 0 || static_cast<std::size_t>(number) >= names_.size()) return nullptr;
    const auto known = sheets_.find(number);
    if (known != sheets_.end()) return &known->second;
    const config::Species& species = species_[static_cast<std::size_t>(number)];
    return &sheets_.emplace(number, makeSheet(species, number)).first->second;
}

std::string lineIn(const std::string& language) {
    const std::vector<std::string> known = languages();
    if (std::ranges::find(known, language) == known.end())
        throw Error("no texts in \"" + language + "\"; there are " + joined(known));
    const std::string path = cli::findData("drawings/texts/" + language + ".json");
    const auto texts = nlohmann::json::parse(config::readTextFile(path), nullptr, false);
    if (!texts.is_object() || !texts.contains("sheet.line") || !texts["sheet.line"].is_string())
        throw Error(path + ": has no \"sheet.line\": write what a sheet says");
    return texts["sheet.line"];
}

}  // namespace aquarama::drawings
