// SPDX-License-Identifier: Apache-2.0
// What the commands of `aquarama study` share: where their data goes, and who draws it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/base/files.h"

namespace aquarama {

// A Python script that prints tables of a study and draws its figure, and the modules that it
// needs.
struct StudyScript {
    std::string path;  // as cli::findData() takes it
    std::vector<std::string> modules;
};

// The folder for the data: the requested one, or a temporary one that is removed with this object.
class StudyData {
  public:
    // Call it before the work. Throws Error where the folder cannot be written or Python is
    // missing. No folder: its name is empty.
    static void require(const StudyScript& script, const std::string& asked);
    // `asked` and `script` as above.
    StudyData(StudyScript script, const std::string& asked);

    // Prints the file's name on stderr where it is kept: stdout is for the tables.
    void write(const std::string& name, const std::string& text) const;
    // Whether the folder was asked for.
    [[nodiscard]] bool isKept() const { return isKept_; }
    // Runs the script, which prints the tables, with these arguments around the folder.
    void show(const std::string& what, const std::string& more) const;

  private:
    StudyScript script_;
    std::filesystem::path path_;
    bool isKept_;
    std::optional<TemporaryFolder> made_;
};

// The line by which docs/studies.py knows what moved the fish.
[[nodiscard]] std::string versionsLine();

}  // namespace aquarama
