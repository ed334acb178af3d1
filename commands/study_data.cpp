// SPDX-License-Identifier: Apache-2.0
#include "commands/study_data.h"

#include <iostream>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "common/base/movement_versions.h"
#include "common/cli/outputs.h"

namespace aquarama {

void StudyData::require(const StudyScript& script, const std::string& asked) {
    cli::requireFolder("--out", asked);
    cli::requirePython(script.modules);
}

StudyData::StudyData(StudyScript script, const std::string& asked)
    : script_(std::move(script)), path_(asked), isKept_(!asked.empty()) {
    if (isKept_) return;
    made_.emplace("study");
    path_ = made_->path();
}

void StudyData::write(const std::string& name, const std::string& text) const {
    writeWhole(path_ / name, std::as_bytes(std::span(text)));
    if (isKept_) std::cerr << (path_ / name).string() << '\n';
}

void StudyData::show(const std::string& what, const std::string& more) const {
    cli::runPython(script_.modules, script_.path, {what, path_.string(), more}, path_);
}

std::string versionsLine() {
    return fmt::format("motor {}, minds {}\n", kMotorVersion, kMindsVersion);
}

}  // namespace aquarama
