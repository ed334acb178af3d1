// SPDX-License-Identifier: Apache-2.0
#include "common/cli/outputs.h"

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <system_error>

#include <unistd.h>

#include "common/units/log.h"

namespace aquarama::cli {

namespace {

namespace fs = std::filesystem;

// Makes the folder and a file in it, which goes again.
std::error_code tryFolder(const fs::path& folder) {
    std::error_code failure;
    fs::create_directories(folder, failure);
    if (failure) return failure;
    std::string probe = (folder / ".aquarama-XXXXXX").string();
    const int file = mkstemp(probe.data());
    if (file < 0) return {errno, std::system_category()};
    close(file);
    unlink(probe.c_str());
    return {};
}

void require(const std::string& option, const std::string& path, const std::error_code& failure) {
    if (failure)
        throw Error(option + " " + path + ": cannot be written (" + failure.message() +
                    "); choose another folder");
}

}  // namespace

void requireFolder(const std::string& option, const std::string& folder) {
    if (!folder.empty()) require(option, folder, tryFolder(folder));
}

void requireFile(const std::string& option, const std::string& file) {
    if (file.empty()) return;
    require(option,
            file,
            fs::is_directory(file) ? std::make_error_code(std::errc::is_a_directory)
                                   : tryFolder(fs::absolute(file).parent_path()));
}

}  // namespace aquarama::cli
