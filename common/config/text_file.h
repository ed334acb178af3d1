// SPDX-License-Identifier: Apache-2.0
// A text file as its readers know it: read whole, of one of three kinds, with places in it.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "common/base/log.h"

namespace aquarama::config {

// Where something stands in a file, for messages. Both count from 1; 0 when built in code.
struct SourcePlace {
    int line = 0;
    int column = 0;
};

// "file:line:column: why"
[[nodiscard]] std::string placed(const std::string& source,
                                 SourcePlace place,
                                 const std::string& why);

// A mistake in a file.
struct FileMistake {
    std::string field;  // its path, as "open.0.from"; empty: the file as a whole
    SourcePlace place;
    std::string why;  // what is wrong and what to do
};

// The mistakes of one file, at least one. Its line is of the first, with the place.
struct FileError : Error {
    FileError(const std::string& source, std::vector<FileMistake> mistakesFound)
        : Error{placed(source, mistakesFound.at(0).place, mistakesFound.at(0).why)},
          mistakes{std::move(mistakesFound)} {}
    std::vector<FileMistake> mistakes;  // in the order in which they were found
};

// The whole file as UTF-8, without a byte order mark and with '\n' at the ends of lines. Throws
// Error when it is of another encoding, cannot be read or is larger than a master may send to its
// nodes (1 MiB; a large rig or species takes some 10 KB).
[[nodiscard]] std::string readTextFile(const std::string& path);

// A path that the file `file` gives relative to its own folder.
[[nodiscard]] std::string besideFile(const std::string& file, const std::string& path);

// All three end in .txtpb; what they hold tells them apart.
enum class FileKind : std::uint8_t { Rig, Scene, Species };

// The kind whose schema has the most of the text's outermost fields, so that a file with a mistake
// is still known; a rig where none has any.
[[nodiscard]] FileKind fileKindOf(const std::string& text);

}  // namespace aquarama::config
